// The equations of a periodic orbit by shooting, with their derivatives.
//
// An orbit of n periods of the forcing is split into p shooting intervals at s_i = i n T / p. The states y_i there are
// the unknowns,
//
//   F_i = phi(s_i -> s_i+1)(y_i; p) - y_i+1 = 0 ,    M_i = d phi / d y_i ,    b_i = d phi / d p              [A-shoot]
//
// with y_p = y_0. Source: R. Seydel, Practical Bifurcation and Stability Analysis, 3rd ed., ch. 7. F is as smooth as
// the flow: across kinks of a continuous vector field once differentiable.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/matrix_product.hpp"
#include "integrate/flow.hpp"

namespace epicyclic::analysis {

/// One evaluation at states y_i, the columns of a dimension x p matrix.
struct Shot {
  Eigen::MatrixXd residual;                    ///< F_i in column i
  std::vector<Eigen::MatrixXd> interval_maps;  ///< M_i; empty if only residuals were requested
  Eigen::MatrixXd parameter;                   ///< b_i in column i; empty unless requested
  integrate::Evolution evolution;  ///< of the interval whose end was not reached; then all other members are undefined

  /// M_p-1 ... M_0: how a small change of y_0 comes back.
  [[nodiscard]] MatrixProduct monodromy() const { return {interval_maps}; }
};

/// Residuals and their derivatives.
/// @param y        states at the beginnings of the shooting intervals, one a column
/// @param periods  n
/// @throws as Flow::evolve_tangents()
[[nodiscard]] Shot shoot(integrate::Flow& flow, const Eigen::MatrixXd& y, Eigen::Index periods,
                         integrate::LastTangent last = integrate::LastTangent::homogeneous);

/// Residuals alone.
[[nodiscard]] Shot shoot_states(integrate::Flow& flow, const Eigen::MatrixXd& y, Eigen::Index periods);

/// A stretch of an orbit within one period of the forcing, with the state that it begins with.
struct Stretch {
  double from = 0, to = 0;  ///< s
  Eigen::VectorXd state;
};

/// The orbit as stretches, each integrated from the one before or from the beginning of its shooting interval.
/// @returns none if one was not reached
[[nodiscard]] std::vector<Stretch> stretches(integrate::Flow& flow, const Eigen::MatrixXd& y, Eigen::Index periods);

/// Integrates y.col(0) to the beginnings of all shooting intervals.
/// @returns the outcome; the states are undefined unless it is `reached`
integrate::Evolution integrate_to_intervals(integrate::Flow& flow, Eigen::Index periods, Eigen::MatrixXd& y);

}  // namespace epicyclic::analysis
