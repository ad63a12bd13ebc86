// A part of a study, which one process computes.
#pragma once

#include <compare>
#include <cstddef>

namespace epicyclic::store {

/// One of the parts to which the chains or draws of a study are dealt.
struct Part {
  std::size_t number = 0;  ///< from 1
  std::size_t of = 0;      ///< how many there are; 0: the study is not computed in parts

  friend auto operator<=>(const Part&, const Part&) = default;
};

/// Index of the first item of a list that a part computes; then each `of`-th one.
/// @param before  number of items that were dealt to the parts before this list
[[nodiscard]] constexpr std::size_t first_of(const Part& part, std::size_t before = 0) {
  return (part.number - 1 + part.of - before % part.of) % part.of;
}

}  // namespace epicyclic::store
