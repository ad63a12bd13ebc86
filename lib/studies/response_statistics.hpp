// Statistics of meshes and bearings over whole mesh periods: means, alternating parts, extrema, contact, tension, load
// sharing, mesh harmonics.
//
//   mean and RMS   x_m = mean x ,  x_rms = sqrt( mean (x - x_m)^2 ) , about the mean                        [S-rms]
//   load sharing   L_i = N x_i / sum_j x_j  of the time means of F_i and of the largest F_i                   [S-share]
//   largest force  max F_i / F_0 ,  F_0 = T_D / (N r_bs): all effects in one number                           [S-force]
//   dynamic factor K_v,i = max F_i / max F_qs,i                                                               [S-kv]
//   load factor    K_gamma = N max_i max_s F_qs,i / sum_j mean_s F_qs,j                                     [S-kgamma]
//   life           L10 of bearings whose load rating is known, by the mean of F^p                            [G-life]
//   harmonics      x_h = 2 | mean x(s) e^(-i h s) | ,  h = 1, 2, 3, over whole periods                        [S-harm]
//
// F_qs,i(s) is the force of the same mesh in the quasi-static solution [model/static_equilibrium.hpp], at the phases of
// the record.
//
// Means are those of samples at uniform phases. Extrema are those of more samples: at least four times as many, and at
// least 20 per period of the fastest mode that meshes excite (2 omega_sn). They include both sides of each breakpoint,
// where forces jump. Limit: a peak between two samples is not seen; `force_error` estimates the error.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/poincare.hpp"
#include "core/lanes.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::studies {

/// omega / omega_sn of the fastest modes that meshes excite, about.
inline constexpr double fastest_mode = 2.0;

/// Samples for extrema per sample for means [S-sampling]; at most some 8192 in all.
/// @param phases  samples for means, per mesh period
[[nodiscard]] int extrema_refinement(const model::DynamicModel& model, int phases);

/// Those of a mesh period at which a response is recorded: both sides of each breakpoint too.
/// @param phases  samples for means
/// @param times   as many more between two of them
[[nodiscard]] inline analysis::RecordingPhases recording_phases(const model::DynamicModel& model, int phases,
                                                                int times = 1) {
  return {model, phases, times * extrema_refinement(model, phases)};
}

/// Of something over time; no numbers where nothing was seen.
struct Course {
  double least = std::numeric_limits<double>::quiet_NaN();
  double largest = least;
  double mean = least;
  double rms = least;  ///< about the mean [S-rms]

  [[nodiscard]] double range() const { return largest - least; }
};

/// What was seen of one mesh over some periods.
struct MeshRecord {
  Course delta;                                             ///< deflection [b_c]
  Course force;                                             ///< F, damping included [N]
  double drive = std::numeric_limits<double>::quiet_NaN();  ///< part of the time on that flank [-]; likewise none
  double back = drive;
  double tension = 0;       ///< largest tension [model::tensile_force()], over the static force of a sun mesh [-]
  double tension_time = 0;  ///< part of the time that there is tension [-]
  Course quasi_static;      ///< force over a mesh period of the quasi-static solution [N]

  /// dynamic_factor() of it.
  [[nodiscard]] double kv() const;

  /// Part of the time out of contact: what the flanks leave [-].
  [[nodiscard]] double loss() const;

  /// "drive+loss" and so on.
  [[nodiscard]] std::string contact() const;
};

/// Amplitudes of the first harmonics of the mesh frequency [b_c].
using MeshHarmonics = std::array<double, 3>;

/// K_v [S-kv] of a mesh.
/// @returns not a number if the mesh has no force in the quasi-static solution, or if there is no such solution
[[nodiscard]] inline double dynamic_factor(double largest_force, const Course& quasi_static) {
  return quasi_static.largest > 0.0 ? largest_force / quasi_static.largest : std::numeric_limits<double>::quiet_NaN();
}

struct StageRecord {
  std::vector<MeshRecord> sun_planet;   ///< one per planet
  std::vector<MeshRecord> ring_planet;  ///< one per planet; of a pair one without forces, always in contact
  double planet_spread = 0;             ///< largest difference between planets' deflections of one kind of mesh [b_c]
  std::vector<Course> planet_bearing;   ///< magnitude of the force, one per planet [N]
  Course sun_bearing;                   ///< likewise
  std::vector<gear::BearingLife> planet_lives;  ///< one per planet if the load rating of their bearings is known
  std::optional<gear::BearingLife> sun_life;    ///< likewise
  Course transmission_error;                    ///< [S-te] [b_c]
  MeshHarmonics sun_planet_harmonics{}, ring_planet_harmonics{};  ///< of the deflections of planet 1
  MeshHarmonics transmission_error_harmonics{};
  /// Estimated relative error of the largest forces by sampling [S-sampling]: a third of what twice as many samples add
  /// to the largest force, of the mesh or bearing where that is most.
  double force_error = 0;
  double static_force = 0;    ///< F_0 [N]
  double mesh_frequency = 0;  ///< omega_m [rad/s]
  gear::Speeds speeds{};

  /// Of a pair of gears: one planet, and nothing is known of a force of the ring's mesh.
  [[nodiscard]] bool is_pair() const {
    return sun_planet.size() == 1 && ring_planet.size() == 1 && std::isnan(ring_planet.front().force.largest);
  }

  /// [S-share] of planets' meshes of one kind, by a number of each.
  /// @returns not a number of forces without a sum
  [[nodiscard]] static double share(const std::vector<MeshRecord>& meshes, double Course::*of, std::size_t planet);
  /// The largest share that a planet has on any of its meshes, of the mean forces or of the largest ones [S-share].
  [[nodiscard]] double largest_share(double Course::*of = &Course::mean) const;
  /// The largest force of any of them over the static one [S-force].
  [[nodiscard]] double dynamic_factor(const std::vector<MeshRecord>& meshes) const;
  /// K_v of the one with the largest force [S-kv].
  [[nodiscard]] static double kv(const std::vector<MeshRecord>& meshes);
  /// K_gamma [S-kgamma].
  [[nodiscard]] static double k_gamma(const std::vector<MeshRecord>& meshes);
  /// Largest tension of any of them, and the largest part of the time with tension in one of them.
  [[nodiscard]] static double tension(const std::vector<MeshRecord>& meshes);
  [[nodiscard]] static double tension_time(const std::vector<MeshRecord>& meshes);
  /// Largest part of the time that one of them is out of contact.
  [[nodiscard]] static double loss_time(const std::vector<MeshRecord>& meshes);
  /// Shortest life of a planet's bearing [h]; not a number if none is known.
  [[nodiscard]] double shortest_life() const;
  /// Largest force of a planet's bearing [N].
  [[nodiscard]] double largest_bearing_force() const;
};

/// Forces of the sun meshes, then of the ring meshes, over a mesh period of the quasi-static solution [N].
/// @returns nothing where there is no such solution, or no load
/// @param phases  uniform ones; extrema are those of both sides of each breakpoint, too
[[nodiscard]] std::vector<Course> quasi_static_forces(const model::DynamicModel& model, int phases);

/// What is kept or computed beside the statistics.
struct StatisticsOptions {
  bool signal = false;       ///< delta_sp_1 at each phase, for signal()
  bool quasi_static = true;  ///< quasi_static_forces()
};

/// Takes a trajectory at uniform phases of its dense output.
class ResponseStatistics {
 public:
  /// @param model   must live longer
  /// @param phases  samples per mesh period that means are taken over
  ResponseStatistics(const model::DynamicModel& model, int phases, StatisticsOptions options = {});

  /// Phases of a period at which see() takes the state, in their order.
  [[nodiscard]] const std::vector<double>& phases() const { return phases_.s; }

  void see(std::span<const double> y);

  /// What was seen. The watch is over.
  [[nodiscard]] StageRecord finish();

  /// The deflection of the sun mesh of planet 1 at all phases seen [b_c].
  [[nodiscard]] const std::vector<double>& signal() const { return signal_; }

 private:
  using Numbers = Lanes<model::phases_together>;

  /// Samples of one number, side by side.
  struct Sums {
    Numbers first, least, largest;
    Numbers sum, squares;  ///< of what is beyond the first one: it would else be lost in the mean
  };
  /// Of one mesh.
  struct Counts {
    Numbers drive{0.0}, back{0.0}, tensile{0.0}, tension{0.0};
  };

  /// A bearing with a load rating, and the sum of F^p at uniform phases [G-life].
  struct Rated {
    std::size_t row;
    gear::RatedBearing bearing;
    double sum = 0;
  };

  void recording(std::size_t group, std::size_t count);
  [[nodiscard]] gear::BearingLife life(const Rated& rated) const;
  void count_contact(const model::OutputRows::Mesh& at, double half_gap, const Numbers& one, Counts& counts) const;
  [[nodiscard]] Course course(std::size_t row, double unit) const;
  [[nodiscard]] double force_error() const;
  [[nodiscard]] MeshRecord mesh(const model::OutputRows::Mesh& at, const Counts& counts) const;
  [[nodiscard]] MeshHarmonics harmonics(const std::vector<double>& profile) const;

  const model::DynamicModel& model_;
  model::OutputRows rows_;
  analysis::RecordingPhases phases_;
  std::size_t count_;  ///< of the uniform phases
  /// Of each group of phases: 1 of a sample of that kind, else 0.
  std::vector<Numbers> uniform_, odd_;
  model::StageOutputs recording_;
  std::vector<Numbers> states_, now_;  ///< of the present group
  std::vector<Sums> sums_;
  std::vector<std::size_t> forces_;  ///< rows of forces of meshes and bearings
  std::vector<Rated> rated_planets_, rated_sun_;
  std::vector<Numbers> coarse_;  ///< their largest values without the odd samples
  std::vector<Counts> sun_planet_, ring_planet_;
  Numbers spread_{0.0};
  /// Sums over the periods at each phase: of delta_sp_1, delta_rp_1 and the transmission error.
  std::array<std::vector<double>, 3> profiles_;
  std::size_t seen_ = 0;
  std::size_t weighed_ = 0;  ///< of them at uniform phases
  StatisticsOptions options_;
  std::vector<double> signal_;
};

}  // namespace epicyclic::studies
