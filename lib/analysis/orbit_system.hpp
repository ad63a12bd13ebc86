// The equations of periodic orbits in any number of parameters, closed by as many more, and Newton's method on them.
//
// With k parameters p the orbits F(y_0 ... y_p-1, p) = 0 [A-shoot] are a manifold of k dimensions. A point of it is
// taken where k further equations hold, each of which keeps a component of z - z* along a given direction [A-length],
// or a parameter as it is. One parameter: a branch [A-plane]; two: a surface, on which loci lie [A-locus].
//
// The solutions T_i of F_z T = 0 with the i-th component 1 and the others 0 are tangents of the manifold. Newton's
// method stays among the states that the family's symmetry leaves as they are.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "analysis/orbit_family.hpp"
#include "analysis/shooting.hpp"

namespace epicyclic::analysis {

/// A place, or a direction, in the space of the states and all parameters.
struct OrbitPlace {
  Eigen::MatrixXd states;  ///< y_i in column i
  Eigen::VectorXd values;  ///< of the parameters
};

[[nodiscard]] OrbitPlace operator+(const OrbitPlace& a, const OrbitPlace& b);
[[nodiscard]] OrbitPlace operator-(const OrbitPlace& a, const OrbitPlace& b);
[[nodiscard]] OrbitPlace operator*(double factor, const OrbitPlace& a);

/// [A-length] with a term for each parameter.
/// @param scales  of the parameters
/// @throws DomainError for different subdivisions
[[nodiscard]] double inner_product(double state_scale, const Eigen::VectorXd& scales, const OrbitPlace& a,
                                   const OrbitPlace& b);

/// F at a place with its derivatives by the states, and by each parameter.
struct OrbitShot {
  Shot shot;
  std::vector<Eigen::MatrixXd> by_value;  ///< dF_i / dp in column i, one for each parameter
};

/// F at a point of a branch with its derivatives by the states.
/// @returns that by the parameter: the flows' own, or by differences
[[nodiscard]] Eigen::MatrixXd shot_with_parameter(const OrbitFamily& family, const CurvePoint& z, Shot& shot);

/// dF/dp by residuals beside p: central, or one-sided where a side was not reached.
/// @param shot   at p; its evolution becomes that of the sides if neither was reached
/// @param flows  over p
[[nodiscard]] Eigen::MatrixXd parameter_difference(const integrate::FlowFamily& flows, const Eigen::MatrixXd& states,
                                                   double value, double step, int period, Shot& shot);

/// One of the equations that close the system.
struct ClosingRow {
  const OrbitPlace* along = nullptr;  ///< direction of which it keeps the component; null: a parameter itself
  Eigen::Index value = 0;             ///< that parameter
};

/// What Newton's method came to.
struct NewtonOutcome {
  bool found = false;
  OrbitPlace at;
  OrbitShot last;         ///< before the last step, as its derivatives are kept
  double residual = 0;    ///< max |F| there
  int evaluations = 0;    ///< of F with its derivatives
  double distance = 0;    ///< from the guess, as a length
  std::string message{};  ///< why not found
};

class OrbitSystem {
 public:
  using Evaluate = std::function<OrbitShot(const OrbitPlace&)>;

  /// @param family    the settings of Newton's method, scale of the states, symmetry and shooting intervals; its flows
  ///                  are not used
  /// @param scales    of the parameters
  /// @param evaluate  F
  OrbitSystem(const OrbitFamily& family, Eigen::VectorXd scales, Eigen::Index dimension, Evaluate evaluate);

  /// As many rows as parameters.
  [[nodiscard]] NewtonOutcome newton(OrbitPlace z, const std::vector<ClosingRow>& rows);

  /// T with F_z T = 0, component `row` 1 and the others 0.
  [[nodiscard]] OrbitPlace tangent(const OrbitShot& shot, const std::vector<ClosingRow>& rows, Eigen::Index row);

  /// As many tangents as parameters, orthonormal, without closing rows.
  [[nodiscard]] std::vector<OrbitPlace> tangents(const OrbitShot& shot);

  [[nodiscard]] double inner(const OrbitPlace& a, const OrbitPlace& b) const;
  [[nodiscard]] double length(const OrbitPlace& a) const;

 private:
  void set(const OrbitShot& shot, const std::vector<ClosingRow>& rows);
  [[nodiscard]] OrbitPlace solve(const Eigen::MatrixXd& r, const Eigen::VectorXd& last) const;
  [[nodiscard]] OrbitPlace place_of(const Eigen::VectorXd& c) const;
  [[nodiscard]] double weight() const;

  const OrbitFamily& family_;
  Eigen::VectorXd scales_;
  Evaluate evaluate_;
  Eigen::MatrixXd kept_;  ///< V: states among which Newton's method stays, y = V c
  Eigen::Index shooting_intervals_;
  Eigen::MatrixXd matrix_;  ///< F_z with the rows, in the coordinates c and parameters in their scales
};

[[nodiscard]] bool finite(const OrbitPlace& z);

/// The cubic through two places with their directions, at the fraction x; its parameter is the length along a's
/// direction.
/// @param along_b  <direction of b, direction of a>
template <class Place>
[[nodiscard]] Place cubic_between(const Place& a, const Place& slope_of_a, const Place& b, const Place& slope_of_b,
                                  double h, double along_b, double x) {
  const Place chord = b - a;
  const Place slope_b = (h / along_b) * slope_of_b;
  const Place slope_a = h * slope_of_a;
  return a + (x * x * (3.0 - 2.0 * x)) * chord + (x * (1.0 - x) * (1.0 - x)) * slope_a + (x * x * (x - 1.0)) * slope_b;
}

}  // namespace epicyclic::analysis
