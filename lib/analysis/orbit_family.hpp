// Periodic orbits of a family of flows as a curve: the solutions z = (y_0 ... y_p-1, lambda) of the shooting equations.
//
// One more unknown than equations. A point of the curve near a guess z* is taken in a plane through it,
//
//   F(z) = 0 ,   <t, z - z*> = 0                                                                        [A-plane]
//
// by Newton's method. Its matrix is regular wherever the orbit is (I - M is) and at folds, since t, the direction of
// the curve nearby, is not in the plane. The direction is the solution of F_z t' = 0, <t, t'> = 1, normed. Lengths are
//
//   <a, b> = sum_i a_i . b_i / (p n Y^2) + a_lambda b_lambda / L^2                                      [A-length]
//
// n the dimension, Y and L the scales of state and parameter: a length of 1 is a change of each component by Y or of
// the parameter by L. Source: H. B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems (1977);
// R. Seydel, Practical Bifurcation and Stability Analysis, 3rd ed., ch. 4.
//
// With neutral directions [A-neutral] F is taken modulo shifts along them, which is sound since phi(y + C v) =
// phi(y) + C v: an orbit may drift along them from period to period.
//
// Smoothness: the curve is as smooth as the flow. Where an orbit grazes a kink of a continuous vector field it is once
// differentiable, and Newton's method still converges, faster than linearly.
#pragma once

#include <complex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "analysis/invariant_blocks.hpp"
#include "integrate/make_flow.hpp"

namespace epicyclic::analysis {

struct OrbitFamily {
  integrate::FlowFamily flows;
  int period = 1;              ///< n, in periods of the forcing
  int shooting_intervals = 1;  ///< p of multiple shooting
  double value_scale = 1;      ///< L
  double state_scale = 1;      ///< Y

  CyclicSymmetry symmetry{};   ///< of the flows, if they have one
  bool keeps_symmetry = true;  ///< the orbits are those that it leaves as they are: Newton's method stays among them

  /// Directions in which all states may be shifted without changing the flows, as columns: a free rigid rotation.
  /// Orbits close up to a shift along them, and are compared by their states orthogonal to them [A-neutral].
  Eigen::MatrixXd neutral{};

  double residual = 1e-10;  ///< max |F| that Newton's method ends below; the orbit is nearer by its last step
  double known = 1e-6;      ///< last step, as a length, with which a state is on an orbit though the residual no longer
                            ///< falls
  int iterations = 10;
  double difference = 1e-6;  ///< step, in L, of the difference for fields that have no parameter derivative

  /// The symmetry that the orbits keep, with the neutral directions.
  [[nodiscard]] CyclicSymmetry kept() const {
    CyclicSymmetry s = keeps_symmetry ? symmetry : CyclicSymmetry{};
    s.neutral = neutral;
    return s;
  }

  /// @throws InputError for a period, shooting intervals or iterations below 1, or scales that are not positive
  void validate() const;
};

/// Checks with the field, at the phases and shifts of a probe, that the neutral directions are neutral.
/// @param state  about which to probe
/// @throws InputError if they are not, if the symmetry and its transpose do not keep their subspace, or if it has
/// another dimension
void check_neutral(const OrbitFamily& family, double value, std::span<const double> state);

/// Multipliers of an orbit of the family by falling modulus, without the ones of neutral directions.
[[nodiscard]] std::vector<std::complex<double>> multipliers_of(const OrbitFamily& family,
                                                               const MatrixProduct& monodromy);

/// The states without their parts in neutral directions.
[[nodiscard]] Eigen::MatrixXd without_shift(const OrbitFamily& family, const Eigen::MatrixXd& states);

/// States among which Newton's method stays, y = V c: V, with orthonormal columns.
[[nodiscard]] Eigen::MatrixXd kept_states(const OrbitFamily& family, Eigen::Index dimension);

/// A place, or a direction, in the space of the states and the parameter.
struct CurvePoint {
  Eigen::MatrixXd states;  ///< y_i in column i
  double value = 0;        ///< lambda
};

[[nodiscard]] CurvePoint operator+(const CurvePoint& a, const CurvePoint& b);
[[nodiscard]] CurvePoint operator-(const CurvePoint& a, const CurvePoint& b);
[[nodiscard]] CurvePoint operator*(double factor, const CurvePoint& a);

/// [A-length]
/// @throws DomainError for different subdivisions
[[nodiscard]] double inner_product(const OrbitFamily& family, const CurvePoint& a, const CurvePoint& b);
[[nodiscard]] double length(const OrbitFamily& family, const CurvePoint& a);

/// An orbit of the family.
struct BranchOrbit {
  CurvePoint at;
  CurvePoint direction;     ///< of length 1
  MatrixProduct monodromy;  ///< M
  double residual = 0;      ///< max |F| before the last step
};

/// What Newton's method came to.
struct Correction {
  bool found = false;
  BranchOrbit orbit;      ///< if found
  int evaluations = 0;    ///< of F with its derivatives
  double distance = 0;    ///< from the guess, as a length
  std::string message{};  ///< why not found
};

/// The orbit in the plane through `guess` that `normal` stands on [A-plane]; its direction goes along with `normal`.
/// @throws as make_flow()
[[nodiscard]] Correction correct(const OrbitFamily& family, const CurvePoint& guess, const CurvePoint& normal);

/// The orbit at a value of the parameter, near `guess`; its direction is that of a rising parameter, unless `along` is
/// given, with which it goes.
[[nodiscard]] Correction correct_at(const OrbitFamily& family, double value, const Eigen::MatrixXd& guess,
                                    const CurvePoint* along = nullptr);

/// The orbit between a and its neighbour b, in the plane there that stands on a's direction.
/// @param part  fraction of the distance, in [0, 1]
[[nodiscard]] Correction between(const OrbitFamily& family, const BranchOrbit& a, const BranchOrbit& b, double part);

/// The states of the trajectory from y at the beginnings of the family's shooting intervals.
/// @returns nothing if the integration failed; without shifts along neutral directions
[[nodiscard]] std::optional<CurvePoint> split_into_intervals(const OrbitFamily& family, const Eigen::VectorXd& y,
                                                             double value);

/// The orbit at a value from one state, split into the family's shooting intervals.
/// @throws as check_neutral()
[[nodiscard]] Correction first_orbit(const OrbitFamily& family, double value, std::span<const double> state);

}  // namespace epicyclic::analysis
