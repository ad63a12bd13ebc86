#include "analysis/smoothing_bias.hpp"

#include <cmath>
#include <cstddef>

#include "core/dense.hpp"
#include "core/errors.hpp"

namespace epicyclic::analysis {

namespace {

/// v_0 through three widths.
double intercept(std::span<const SmoothedValue, 3> values) {
  // In parts of the coarsest width, for the scaling of the matrix.
  const double unit = values[0].width;
  Eigen::MatrixXd a(3, 3);
  Eigen::VectorXd v(3);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const SmoothedValue& s = values[static_cast<std::size_t>(i)];
    const double w = s.width / unit;
    a.row(i) << 1.0, w * w * std::log(w), w * w;
    v(i) = s.value;
  }
  return solution(a, v)(0);
}

}  // namespace

ExactValue extrapolated_to_exact(std::span<const SmoothedValue> values, double safety) {
  if (values.size() < 4) throw DomainError("four widths are needed to extrapolate to the exact clearance");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i].width > 0.0) || (i > 0 && !(values[i].width < values[i - 1].width)))
      throw DomainError("widths of the smooth clearance must be positive and fall");
  const double fine = intercept(values.last<3>());
  const double coarse = intercept(values.last(4).first<3>());
  return {fine, safety * std::abs(fine - coarse)};
}

}  // namespace epicyclic::analysis
