#include "core/root_finding.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>

#include <gsl/gsl_roots.h>

#include "core/errors.hpp"

namespace epicyclic {

namespace {

/// An exception must not cross GSL's C frames, and a value that is not finite would reach GSL's error handler, which
/// ends the program: both are kept, a root is feigned to end the search, and they are thrown behind it.
struct Call {
  const std::function<double(double)>& f;
  std::exception_ptr thrown;
  bool finite = true;

  static double evaluate(double x, void* self) {
    auto& call = *static_cast<Call*>(self);
    try {
      const double value = call.f(x);
      if (std::isfinite(value)) return value;
      call.finite = false;
    } catch (...) {
      call.thrown = std::current_exception();
    }
    return 0.0;
  }
};

}  // namespace

double find_root(const std::function<double(double)>& f, double low, double high, double width) {
  if (!(low < high)) throw DomainError("find_root: the ends must rise");
  const double at_low = f(low);
  const double at_high = f(high);
  if (at_low == 0.0) return low;
  if (at_high == 0.0) return high;
  // GSL's own checks would call its error handler, which ends the program.
  if (!std::isfinite(at_low) || !std::isfinite(at_high) || (at_low > 0.0) == (at_high > 0.0))
    throw DomainError("find_root: the function does not change its sign between the ends");
  Call call{f, nullptr, true};
  gsl_function function{&Call::evaluate, &call};
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  gsl_root_fsolver_set(solver.get(), &function, low, high);
  constexpr int iterations_max = 200;
  for (int k = 0; k < iterations_max; ++k) {
    const double x_low = gsl_root_fsolver_x_lower(solver.get());
    const double x_high = gsl_root_fsolver_x_upper(solver.get());
    const double resolution = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(x_high);
    if (!(std::abs(x_high - x_low) > std::max(width, resolution))) break;
    gsl_root_fsolver_iterate(solver.get());
    if (call.thrown) std::rethrow_exception(call.thrown);
    if (!call.finite) throw DomainError("find_root: the function is not finite between the ends");
  }
  return gsl_root_fsolver_root(solver.get());
}

std::optional<double> secant_root(const std::function<std::optional<double>(double)>& f, double beside, double span) {
  double x_before = beside;
  std::optional<double> f_before = f(x_before);
  double x = 0.0;
  std::optional<double> f_now = f_before ? f(x) : std::nullopt;
  constexpr int iterations = 8;
  for (int k = 0; k < iterations && f_now; ++k) {
    if (*f_now == *f_before) break;
    const double next = x - *f_now * (x - x_before) / (*f_now - *f_before);
    if (!(std::abs(next) < span)) return std::nullopt;
    x_before = x;
    f_before = f_now;
    x = next;
    f_now = f(x);
    constexpr double resolved = 1e-11;
    if (f_now && (std::abs(*f_now) < resolved || std::abs(x - x_before) < resolved * span)) break;
  }
  if (!f_now) return std::nullopt;
  return x;
}

}  // namespace epicyclic
