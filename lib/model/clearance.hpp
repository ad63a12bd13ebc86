// Clearance functions: how far a contact is closed when its members are displaced by d and the half gap is b.
//
//   exact    f(d, b)   = d - b (d > b),  0 (|d| <= b),  d + b (d < -b)                                  [M-f]
//   smooth   f_w(d, b) = d + [ sqrt((d - b)^2 + w^2) - sqrt((d + b)^2 + w^2) ] / 2 ,  w -> 0 gives f    [M-fw]
//   radial   g(x, y, b) with  force = g (x, y),  g = f(r, b) / r,  r = hypot(x, y)                      [M-fr]
//
// Source: Kahraman and Singh's piecewise-linear form (Tang et al. 2020 use f without defining it); the smooth form is
// this project's choice. Limits: b >= 0, w >= 0; gap and displacement in the same unit.
// Smoothness: f is C0 with kinks at d = +-b; f_w is analytic for w > 0; both are odd in d, so g is even in r and safe
// at r = 0 for every scalar type (0/0 never arises in the value or in its derivatives).
#pragma once

#include <type_traits>

#include "core/dual.hpp"
#include "core/scalar.hpp"

namespace epicyclic::model {

/// What a clearance answers at one displacement.
template <class T>
struct Closure {
  T value;  ///< f or f_w, in the unit of d
  T slope;  ///< df/dd [-]
};

// The half gap b and the width w may be constants (B) if the displacement has derivatives (T).

/// [M-f] with its slope, which jumps between 0 and 1 at d = +-b. At the kink the closed side's slope is taken, so that
/// b = 0 is f = d with slope 1 at d = 0 too.
template <class T, class B>
[[nodiscard]] Closure<T> closure_exact(const T& d, const B& b) {
  return {select(d < b, select(d > -b, T(0.0), T(d + b)), T(d - b)),
          select(d < b, select(d > -b, T(0.0), T(1.0)), T(1.0))};
}

/// [M-fw] with its slope; w > 0.
template <class T, class B>
[[nodiscard]] Closure<T> closure_smooth(const T& d, const B& b, const B& w) {
  using epicyclic::sqrt;
  const T below = d - b;
  const T above = d + b;
  const T root_below = sqrt(below * below + w * w);
  const T root_above = sqrt(above * above + w * w);
  return {d + 0.5 * (root_below - root_above), 1.0 + 0.5 * (below / root_below - above / root_above)};
}

/// The clearance of the study: smooth if w > 0, else exact. `smooth` is the same for every lane and point of a study.
template <class T, class B>
[[nodiscard]] Closure<T> closure(const T& d, const B& b, const B& w, bool smooth) {
  return smooth ? closure_smooth(d, b, w) : closure_exact(d, b);
}

/// The value alone. For dual numbers it uses the plain value and the plain slope: a fraction of the cost of [M-fw] on
/// them.
template <class T, class B>
[[nodiscard]] T closed_by(const T& d, const B& b, const B& w, bool smooth) {
  if constexpr (!is_dual<B> && !std::is_same_v<T, B> && requires { chained(d, value_of(d), value_of(d)); }) {
    const auto plain = closure(value_of(d), b, w, smooth);
    return chained(d, plain.value, plain.slope);
  } else {
    return closure(d, b, w, smooth).value;
  }
}

/// sqrt(x^2 + y^2) whose derivative at the origin is 0 instead of 0/0.
template <class T>
[[nodiscard]] T safe_radius(const T& x, const T& y) {
  using epicyclic::sqrt;
  constexpr double square_of_nothing = 1e-300;
  return sqrt(x * x + y * y + square_of_nothing);
}

/// g = f(r, b) / r of [M-fr]: the radial clearance as a factor on (x, y). For w > 0 from the form
/// f_w = r (1 - 2 b / (sqrt((r-b)^2 + w^2) + sqrt((r+b)^2 + w^2))), which does not cancel.
template <class T, class B>
[[nodiscard]] T radial_closure_factor(const T& r, const B& b, const B& w, bool smooth) {
  using epicyclic::sqrt;
  if (!smooth) return (r - limited(r, T(-b), T(b))) / r;
  const T factor = 1.0 - 2.0 * b / (sqrt((r - b) * (r - b) + w * w) + sqrt((r + b) * (r + b) + w * w));
  return select(factor > T(0.0), factor, T(0.0));  // rounding may leave -1e-16 inside a gap that is wide against w
}

}  // namespace epicyclic::model
