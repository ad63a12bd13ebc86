// A part of a study of points, which one process computes.
#pragma once

#include <compare>
#include <cstddef>

namespace epicyclic::store {

/// One of the parts into which a study's chains are dealt.
struct Part {
  std::size_t number = 0;  ///< from 1
  std::size_t of = 0;      ///< how many there are; 0: the study is not computed in parts

  friend auto operator<=>(const Part&, const Part&) = default;
};

}  // namespace epicyclic::store
