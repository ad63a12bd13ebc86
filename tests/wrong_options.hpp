// Options that validate() has to refuse, each for one member.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace epicyclic::test {

/// Options with one member wrong.
template <class Options>
struct Wrong {
  std::string member;
  std::function<void(Options&)> set;
};

/// `sound` is accepted, and refused with each of `all`, by a message that begins with the member's name.
template <class Options>
void expect_refused(const Options& sound, const std::vector<Wrong<Options>>& all) {
  EXPECT_NO_THROW(sound.validate());
  for (const auto& [member, set] : all) {
    Options options = sound;
    set(options);
    try {
      options.validate();
      ADD_FAILURE() << member << " was not refused";
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).rfind(member + " ", 0), 0U) << e.what();
    }
  }
}

}  // namespace epicyclic::test
