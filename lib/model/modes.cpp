#include "model/modes.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense.hpp"
#include "model/dispatch.hpp"
#include "model/right_hand_side.hpp"

namespace epicyclic::model {

namespace {

// Frequencies nearer than this, relative to the highest, are one: far above the rounding of the eigenvalue problem,
// far below the digits that anyone prints.
constexpr double same_frequency = 1e-7;
// Squares of rigid-body frequencies come out at rounding level of the largest square.
constexpr double rigid_body_square = 1e-11;
// A share of kinetic energy below this is none: rounding of eigenvectors, squared, with a wide margin.
constexpr double no_share = 1e-9;

template <std::size_t N>
class Assembly {
 public:
  Assembly(const gear::Stage& stage, const Scales& scales)
      : geometry_(make_geometry<N>(stage)), stage_(stage), scales_(scales) {}

  LinearStage build() {
    const auto n = static_cast<Eigen::Index>(size);
    linear_.mass = Eigen::VectorXd::Zero(n);
    linear_.stiffness = Eigen::MatrixXd::Zero(n, n);
    linear_.constraints = Eigen::MatrixXd::Zero(0, n);
    // Column k of each deflection: its value for a unit displacement of slot k.
    std::array<Deflections<double, N>, size> unit;
    for (std::size_t k = 0; k < size; ++k) {
      std::array<double, size> q{};
      q[k] = 1.0;
      unit[k] = deflections(geometry_, unpack<N>(Layout::full, q.data()));
    }
    const auto row = [&](auto&& pick) {
      Eigen::VectorXd l(n);
      for (std::size_t k = 0; k < size; ++k) l(static_cast<Eigen::Index>(k)) = pick(unit[k]);
      return l;
    };
    using D = Deflections<double, N>;
    for (std::size_t i = 0; i < N; ++i) {
      spring(Element::sun_planet_mesh, stage_.sun_planet_mesh.stiffness_N_per_m,
             row([i](const D& d) { return d.sun_planet[i]; }));
      if constexpr (N > 1)
        spring(Element::ring_planet_mesh, stage_.ring_planet_mesh.stiffness_N_per_m,
               row([i](const D& d) { return d.ring_planet[i]; }));
      spring(Element::planet_bearing, stage_.planet.bearing_N_per_m[i],
             row([i](const D& d) { return d.carrier_x[i]; }));
      spring(Element::planet_bearing, stage_.planet.bearing_N_per_m[i],
             row([i](const D& d) { return d.carrier_y[i]; }));
      mass(Slots::x_p(i), stage_.planet.mass_kg[i]);
      mass(Slots::y_p(i), stage_.planet.mass_kg[i]);
      mass(Slots::w_p(i), stage_.planet.inertia_over_r2_kg[i]);
    }
    member(stage_.sun, Slots::x_s, Slots::y_s, Slots::w_s, Element::sun_support, Element::sun_torsion);
    if constexpr (N == 1) {
      spring(Element::planet_bearing, stage_.planet.torsional_support_N_per_m.value_or(0.0),
             Eigen::VectorXd::Unit(n, static_cast<Eigen::Index>(Slots::w_p(0))));
      // A pair has no ring and no carrier: they stand still.
      gear::CentralMember none;
      none.mass_kg = none.inertia_over_r2_kg = scales_.mass;
      none.support_N_per_m = none.torsional_support_N_per_m = gear::rigid;
      member(none, Slots::x_r(N), Slots::y_r(N), Slots::u_r(N), Element::ring_support, Element::ring_torsion);
      member(none, Slots::x_c(N), Slots::y_c(N), Slots::u_c(Layout::full, N), Element::carrier_support,
             Element::carrier_torsion);
      return std::move(linear_);
    }
    member(stage_.ring, Slots::x_r(N), Slots::y_r(N), Slots::u_r(N), Element::ring_support, Element::ring_torsion);
    member(stage_.carrier, Slots::x_c(N), Slots::y_c(N), Slots::u_c(Layout::full, N), Element::carrier_support,
           Element::carrier_torsion);
    return std::move(linear_);
  }

 private:
  static constexpr std::size_t size = degrees_of_freedom(Layout::full, N);

  void mass(std::size_t slot, double kg) { linear_.mass(static_cast<Eigen::Index>(slot)) = scales_.mass_ratio(kg); }

  void spring(Element element, double newton_per_m, const Eigen::VectorXd& l) {
    if (std::isfinite(newton_per_m)) {
      linear_.stiffness += scales_.stiffness(newton_per_m) * l * l.transpose();
      linear_.springs.push_back({element, scales_.stiffness(newton_per_m), l});
      return;
    }
    linear_.constraints.conservativeResize(linear_.constraints.rows() + 1, Eigen::NoChange);
    linear_.constraints.bottomRows(1) = l.transpose();
  }

  void member(const gear::CentralMember& m, std::size_t x, std::size_t y, std::size_t u, Element support,
              Element torsion) {
    const auto unit = [](std::size_t slot) { return Eigen::VectorXd::Unit(size, static_cast<Eigen::Index>(slot)); };
    mass(x, m.mass_kg);
    mass(y, m.mass_kg);
    mass(u, m.inertia_over_r2_kg);
    spring(support, m.support_N_per_m, unit(x));
    spring(support, m.support_N_per_m, unit(y));
    spring(torsion, m.torsional_support_N_per_m, unit(u));
  }

  Parameters<double, N> geometry_;
  const gear::Stage& stage_;
  const Scales& scales_;
  LinearStage linear_;
};

/// Orthonormal basis of the displacements that the constraints leave free.
Eigen::MatrixXd free_displacements(const LinearStage& linear) {
  const Eigen::Index n = linear.mass.size();
  if (linear.constraints.rows() == 0) return Eigen::MatrixXd::Identity(n, n);
  return null_space(linear.constraints);
}

/// M-weighted shares of a shape's displacement.
struct Shares {
  double central_translation = 0, central_rotation = 0;
};

/// Diagonal weights of the two kinds of central displacement: 1 and 2; planets 0.
Eigen::VectorXd central_weights(int planets) {
  const auto n = static_cast<std::size_t>(planets);
  Eigen::VectorXd w = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(degrees_of_freedom(Layout::full, n)));
  for (const std::size_t slot : {Slots::x_s, Slots::y_s, Slots::x_r(n), Slots::y_r(n), Slots::x_c(n), Slots::y_c(n)})
    w(static_cast<Eigen::Index>(slot)) = 1.0;
  for (const std::size_t slot : {Slots::w_s, Slots::u_r(n), Slots::u_c(Layout::full, n)})
    w(static_cast<Eigen::Index>(slot)) = 2.0;
  return w;
}

ModeType classify(const Eigen::VectorXd& shape, const Eigen::VectorXd& mass, const Eigen::VectorXd& weights) {
  Shares shares;
  double total = 0.0;
  for (Eigen::Index k = 0; k < shape.size(); ++k) {
    const double kinetic = mass(k) * shape(k) * shape(k);
    total += kinetic;
    if (weights(k) == 1.0) shares.central_translation += kinetic;
    if (weights(k) == 2.0) shares.central_rotation += kinetic;
  }
  const bool translates = shares.central_translation > no_share * total;
  const bool rotates = shares.central_rotation > no_share * total;
  if (rotates) return translates ? ModeType::other : ModeType::rotational;
  return translates ? ModeType::translational : ModeType::planet;
}

}  // namespace

std::string_view to_string(ModeType type) {
  switch (type) {
    case ModeType::rotational:
      return "rotational";
    case ModeType::translational:
      return "translational";
    case ModeType::planet:
      return "planet";
    case ModeType::other:
      return "other";
  }
  return "other";
}

std::string_view to_string(Element element) {
  static constexpr std::array<std::string_view, element_count> names = {
      "sun_planet_mesh", "ring_planet_mesh", "planet_bearing",  "sun_support",    "sun_torsion",
      "ring_support",    "ring_torsion",     "carrier_support", "carrier_torsion"};
  return names[static_cast<std::size_t>(element)];
}

std::string_view to_string(MemberDisplacement displacement) {
  static constexpr std::array<std::string_view, displacement_count> names = {
      "sun_translation",  "sun_rotation",  "planet_translation",  "planet_rotation",
      "ring_translation", "ring_rotation", "carrier_translation", "carrier_rotation"};
  return names[static_cast<std::size_t>(displacement)];
}

ModalEnergies modal_energies(const LinearStage& linear, const Mode& mode, int planets) {
  const auto n = static_cast<std::size_t>(planets);
  ModalEnergies e;
  double elastic = 0.0;
  if (mode.frequency_ratio > 0.0)
    for (const Spring& spring : linear.springs) {
      const double energy = spring.stiffness * (spring.row.transpose() * mode.shapes).squaredNorm();
      e.elastic[static_cast<std::size_t>(spring.element)] += energy;
      elastic += energy;
    }
  if (elastic > 0.0)
    for (double& share : e.elastic) share /= elastic;

  double kinetic = 0.0;
  const auto add = [&](MemberDisplacement displacement, std::size_t slot) {
    const auto k = static_cast<Eigen::Index>(slot);
    const double energy = linear.mass(k) * mode.shapes.row(k).squaredNorm();
    e.kinetic[static_cast<std::size_t>(displacement)] += energy;
    kinetic += energy;
  };
  add(MemberDisplacement::sun_translation, Slots::x_s);
  add(MemberDisplacement::sun_translation, Slots::y_s);
  add(MemberDisplacement::sun_rotation, Slots::w_s);
  for (std::size_t i = 0; i < n; ++i) {
    add(MemberDisplacement::planet_translation, Slots::x_p(i));
    add(MemberDisplacement::planet_translation, Slots::y_p(i));
    add(MemberDisplacement::planet_rotation, Slots::w_p(i));
  }
  add(MemberDisplacement::ring_translation, Slots::x_r(n));
  add(MemberDisplacement::ring_translation, Slots::y_r(n));
  add(MemberDisplacement::ring_rotation, Slots::u_r(n));
  add(MemberDisplacement::carrier_translation, Slots::x_c(n));
  add(MemberDisplacement::carrier_translation, Slots::y_c(n));
  add(MemberDisplacement::carrier_rotation, Slots::u_c(Layout::full, n));
  for (double& share : e.kinetic) share /= kinetic;
  // Shares at rounding level of the shapes are none.
  constexpr double rounding = 1e-20;
  for (double& share : e.elastic) share = share < rounding ? 0.0 : share;
  for (double& share : e.kinetic) share = share < rounding ? 0.0 : share;
  return e;
}

LinearStage linear_stage(const gear::Stage& stage, const Scales& scales) {
  return with_planets(stage.planet_count, [&]<std::size_t N>() { return Assembly<N>(stage, scales).build(); });
}

std::vector<Mode> modes(const gear::Stage& stage, const Scales& scales) {
  const LinearStage linear = linear_stage(stage, scales);
  const Eigen::MatrixXd basis = free_displacements(linear);
  const Eigen::MatrixXd mass = transposed_product(linear.mass.asDiagonal() * basis, basis);
  const Eigen::MatrixXd stiffness = product(transposed_product(basis, linear.stiffness), basis);
  const SymmetricModes solution = symmetric_modes(stiffness, mass);
  const Eigen::MatrixXd shapes = product(basis, solution.vectors);
  const Eigen::VectorXd weights = central_weights(stage.planet_count);

  const Eigen::Index count = solution.values.size();
  const double largest = solution.values.maxCoeff();
  const auto frequency = [&](Eigen::Index k) {
    const double square = solution.values(k);
    return square < rigid_body_square * largest ? 0.0 : std::sqrt(square);
  };

  std::vector<Mode> result;
  for (Eigen::Index first = 0; first < count;) {
    Eigen::Index last = first + 1;
    while (last < count && frequency(last) - frequency(last - 1) <= same_frequency * std::sqrt(largest)) ++last;
    Eigen::MatrixXd cluster = shapes.middleCols(first, last - first);
    if (last - first > 1) {
      const Eigen::MatrixXd weighted = linear.mass.cwiseProduct(weights).asDiagonal() * cluster;
      cluster = product(cluster, symmetric_modes(transposed_product(weighted, cluster)).vectors);
    }
    const double mean = [&] {
      double sum = 0.0;
      for (Eigen::Index k = first; k < last; ++k) sum += frequency(k);
      return sum / static_cast<double>(last - first);
    }();
    for (const ModeType type : {ModeType::rotational, ModeType::translational, ModeType::planet, ModeType::other}) {
      std::vector<Eigen::Index> members;
      for (Eigen::Index k = 0; k < cluster.cols(); ++k)
        if (classify(cluster.col(k), linear.mass, weights) == type) members.push_back(k);
      if (members.empty()) continue;
      Mode mode{mean, type, static_cast<int>(members.size()), Eigen::MatrixXd(cluster.rows(), members.size())};
      for (std::size_t k = 0; k < members.size(); ++k)
        mode.shapes.col(static_cast<Eigen::Index>(k)) = cluster.col(members[k]);
      result.push_back(std::move(mode));
    }
    first = last;
  }
  return result;
}

}  // namespace epicyclic::model
