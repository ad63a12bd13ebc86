#include "store/part.hpp"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace epicyclic::store::part_test {

/// Lists of these lengths are dealt one after the other, as one list.
TEST(Part, ListsAreDealtOnFromEachOther) {
  for (const std::size_t of : {1U, 3U, 7U}) {
    std::vector<std::size_t> parts;  // of each item, of all lists
    for (const std::size_t length : {4U, 0U, 1U, 11U, 2U}) {
      const std::size_t before = parts.size();
      parts.resize(before + length, 0);
      for (std::size_t number = 1; number <= of; ++number)
        for (std::size_t k = first_of({number, of}, before); k < length; k += of) parts[before + k] += number;
    }
    for (std::size_t k = 0; k < parts.size(); ++k) EXPECT_EQ(parts[k], k % of + 1) << k << " of " << of;
  }
}

}  // namespace epicyclic::store::part_test
