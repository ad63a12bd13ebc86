// Tests that run once for each method, with readable names.
#pragma once

#include <algorithm>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "integrate/methods.hpp"

namespace epicyclic::integrate {

/// What GoogleTest shows of a parameter; found by its namespace.
inline void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

inline std::string name_of(const ::testing::TestParamInfo<Method>& info) {
  std::string name(info.param.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace epicyclic::integrate
