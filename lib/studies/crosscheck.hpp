// The same study by several methods: do they tell the same regime, and the same orbit?
//
// The first method is the reference; it computes the study as a sweep would. At each point every other method starts
// from the state that the reference started from, so that a difference is one of the methods and not of their pasts.
//
//   same n, distance d = min_k max_{r,j} | y'_{r+k,j} - y_{r,j} |  over the Poincare points of an orbit,  d <= eps
//   [A-cross]
//
// What each motion is, is told as by any other study [studies/motion.hpp], by the method that computed it. A difference
// is explained by continuing one answer with the other method, and by computing again with tightened tolerances or with
// the reference's smoothing; where that leaves it open both are followed over thousands of periods and told again; see
// Verdict. Each of these is a computation, so that an explanation is a measurement and not a guess.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "integrate/options.hpp"
#include "studies/crosscheck_options.hpp"
#include "studies/point_source.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

/// A way of computing that is compared with the reference.
struct Variant {
  integrate::IntegratorOptions integrator;
  double clearance_smoothing = 0;
  std::string label;  ///< method, and width where it is not the study's
};

/// The reference first.
/// @param study_smoothing  width of the study
[[nodiscard]] std::vector<Variant> crosscheck_variants(const CrosscheckOptions& options,
                                                       const integrate::IntegratorOptions& integrator,
                                                       double study_smoothing);

enum class Verdict {
  agree,        ///< the same regime; where it is periodic the same period and orbit, where chaotic the same exponent,
                ///< to within both intervals
  coexisting,   ///< each method stays on the other's motion: both are motions of the stage
  tolerance,    ///< with tolerances a hundred times tighter they agree
  smoothing,    ///< with the reference's smoothing they agree
  transient,    ///< continued, both come to the same motion: the transient was too short
  torus,        ///< both are quasiperiodic and fill one set of states: no phase of theirs is right
  chaos,        ///< followed for long, one of them is chaotic at least: states at one instant cannot agree; or one is,
                ///< the other is undecided, and their exponents agree by their intervals
  not_reached,  ///< one of them has no answer (its status says why)
  unexplained,
};
[[nodiscard]] std::string to_string(Verdict verdict);

struct Comparison {
  std::size_t point = 0;  ///< of the reference's
  std::size_t variant = 0;
  PointResult result;
  Verdict verdict = Verdict::agree;
  double distance = 0;  ///< d; not a number where nothing can be compared
  std::string detail;   ///< what the explanation rests on
};

struct Crosscheck {
  std::vector<Variant> variants;
  std::vector<PointResult> reference;   ///< one per point
  std::vector<Comparison> comparisons;  ///< by point, then variant (from 1)
  /// @param points  that were to be compared
  [[nodiscard]] bool complete(std::size_t points) const {
    return reference.size() == points && comparisons.size() == points * (variants.size() - 1);
  }
};

/// d of the first line of [A-cross]; not a number unless both records recur and the motions have one period.
[[nodiscard]] double orbit_distance(const PointResult& a, const PointResult& b, std::size_t dimension);

/// The model at a value of the sweep parameter with another width of the smooth clearance.
using SmoothedModelAt = std::function<model::DynamicModel(double value, double clearance_smoothing)>;

/// How it is run; none of it changes a result.
struct CrosscheckRun {
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;
  /// Results of an earlier run: variant, then point.
  std::map<std::pair<std::size_t, std::size_t>, PointResult> done{};
  std::function<void(std::size_t variant, const PointResult&)> point_finished{};  ///< one at a time
};

/// @returns incomplete if stopped
[[nodiscard]] Crosscheck run_crosscheck(const SweepPlan& plan, const RecordingOptions& recording,
                                        const CrosscheckOptions& options,
                                        const integrate::IntegratorOptions& integrator, double study_smoothing,
                                        const SmoothedModelAt& model_at, const CrosscheckRun& run);

/// Points of a finished sweep that its `check` computes again: as many of each told regime as there are, and of a
/// regime those that stand evenly among its periods and values. In order. Where a carried chain begins is a matter of
/// its own [coarse_pass.hpp], so that no first point of one is among them.
[[nodiscard]] std::vector<std::size_t> points_of_each_regime(const SweepOptions& sweep, const PointSource& finished);

/// points_of_each_regime() by other methods than that of the sweep.
/// @param sweep  whose `check` says how many points, and by which methods
/// @param run    `done` is not read
/// @returns incomplete if stopped
[[nodiscard]] Crosscheck run_check_of_sweep(const SweepOptions& sweep, const PointSource& finished,
                                            const integrate::IntegratorOptions& integrator, double study_smoothing,
                                            const SmoothedModelAt& model_at, const CrosscheckRun& run);

}  // namespace epicyclic::studies
