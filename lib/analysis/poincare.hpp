// Stroboscopic Poincare section of a periodically forced flow, and the period of the response by recurrence.
//
//   y_k = phi(s_0 -> s_0 + k T)(y_0) ,  T the period of the forcing
//   r_n = max_k max_j | y_{k+n,j} - y_{k,j} |  over the whole record
//   period n:  the least n with  r_n <= epsilon  and  r_n <= r_m / 10 for each m < n                         [A-rec]
//
// The second condition is for slow transients towards a short period. A slow beat of the transient may bring the state
// back within epsilon after a long period. Such a response does not count as one of the long period.
//
// A section by a surface h(s, y) = 0 takes the states where h changes sign in one direction. They are bracketed by the
// dense output and located along evolutions of the flow itself, from the sample before them.
//
// Limits: two crossings between neighbouring samples are missed; recurrence can prove that a response repeats to within
// epsilon over the record, nothing else. A response that does not repeat may be chaotic, quasiperiodic, of a longer
// period, or still transient. Smoothness: none needed; the section is stepped onto, not interpolated.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "integrate/flow.hpp"

namespace epicyclic::analysis {

/// Points of a section, row by row.
struct PoincareSection {
  std::size_t dimension = 0;
  std::vector<double> states;  ///< size() x dimension

  [[nodiscard]] std::size_t size() const { return dimension == 0 ? 0 : states.size() / dimension; }
  [[nodiscard]] std::span<const double> point(std::size_t k) const {
    return {states.data() + k * dimension, dimension};
  }
  void keep_last(std::size_t points) {
    if (size() > points) states.erase(states.begin(), states.end() - static_cast<std::ptrdiff_t>(points * dimension));
  }
};

/// Uniform values of s over one period for the dense output. The end of the period is included, its beginning is not.
[[nodiscard]] std::vector<double> uniform_phases(double period, int count);

/// What a sample of a response is for: all samples count for extrema, means are taken over the uniform ones alone.
enum class SampleKind {
  uniform,  ///< one of uniform_phases()
  even,     ///< between two of them, an even multiple of the finest spacing
  odd,      ///< likewise, an odd multiple: without these the spacing is twice as large
  jump,     ///< next to a breakpoint, where forces jump
};

/// Phases of one period at which a response is recorded: `count` uniform ones, `refinement` - 1 between two of them,
/// and both sides of each breakpoint.
struct RecordingPhases {
  std::vector<double> s;  ///< in (0, T], rising
  std::vector<SampleKind> kind;

  /// @param field       periodic
  /// @param count       >= 1
  /// @param refinement  1, or even
  RecordingPhases(const VectorField& field, int count, int refinement);

  [[nodiscard]] std::size_t size() const { return s.size(); }
};

struct StrobeOptions {
  int transient_periods = 300;
  int recorded_periods = 128;
  int phases = 64;  ///< dense output points per recorded period; their number does not change the section

  /// @throws InputError for a negative number of periods, or no phase
  void validate() const;
};

struct Strobe {
  integrate::Evolution evolution;  ///< how it ended; the section holds the points until then
  PoincareSection section;         ///< after each recorded period
};

/// A strobe period by period, for callers that integrate several trajectories at once. Evolve the state from 0 over the
/// period with samples() and observer(), and pass the result to take(), until it is over.
class StrobeProgress {
 public:
  /// @param dimension  of the state
  /// @param options    `phases` is not used
  /// @param samples    phases of each recorded period that `observer` sees (index counts on over the periods)
  /// @throws InputError for options out of range
  StrobeProgress(std::size_t dimension, const StrobeOptions& options, std::vector<double> samples,
                 const integrate::Observer& observer);
  StrobeProgress(const StrobeProgress&) = delete;  // its observer knows where it is
  StrobeProgress& operator=(const StrobeProgress&) = delete;

  /// All periods are integrated, or an evolution failed.
  [[nodiscard]] bool over() const { return !strobe_.evolution.reached() || advanced_ == last_; }
  /// Of the next period; empty in the transient.
  [[nodiscard]] std::span<const double> samples() const;
  [[nodiscard]] const integrate::Observer& observer() const { return see_; }
  void take(const integrate::Evolution& evolution, std::span<const double> state);

  [[nodiscard]] Strobe& result() { return strobe_; }

 private:
  StrobeOptions options_;
  int advanced_ = 0;  ///< periods
  int last_ = 0;
  std::vector<double> samples_;
  integrate::Observer see_;
  Strobe strobe_;
};

/// Integrates a strobe to its end by one flow.
/// @param go_on  called before each period; false ends the strobe there
void advance_strobe(integrate::Flow& flow, std::span<double> state, StrobeProgress& strobe,
                    const std::function<bool()>& go_on);

/// Integrates `state` over the transient, then records.
///
/// @param state     replaced by the last state
/// @param observer  sees each recorded period at phases j T / phases, j = 1 .. phases (index counts on over the
/// periods)
/// @param go_on     called before each period; false ends the strobe at once with what is there (outcome reached)
/// @throws InputError for options out of range
[[nodiscard]] Strobe strobe(integrate::Flow& flow, std::span<double> state, const StrobeOptions& options,
                            const integrate::Observer& observer, const std::function<bool()>& go_on);

enum class SectionCrossing { rising, falling };

/// Crossings of a surface in the order of time.
struct SurfaceSection {
  integrate::Evolution evolution;  ///< how it ended; the section holds the crossings until then
  PoincareSection section;
  std::vector<double> phase;  ///< s of each, in [0, T)
};

/// @param state    initial state, replaced by the last state; its path does not depend on the crossings
/// @param surface  h
/// @param phases   samples per period that bracket crossings
[[nodiscard]] SurfaceSection surface_section(integrate::Flow& flow, std::span<double> state,
                                             const std::function<double(double s, std::span<const double> y)>& surface,
                                             SectionCrossing direction, int periods, int phases,
                                             const std::function<bool()>& go_on);

struct Recurrence {
  int period = 0;         ///< n of [A-rec]; 0 if there is none up to the longest period
  double error = 0;       ///< r_n at that n; the least r_n over all n tried if none recurs
  int best_period = 0;    ///< the n of that error
  double late_error = 0;  ///< the same over the second half of the record: smaller during the transient
};

/// r_n of [A-rec].
/// @param first  the points before it are left out
[[nodiscard]] double recurrence_error(const PoincareSection& section, std::size_t n, std::size_t first = 0);

/// How far `b` leaves `a`: the largest distance of a point of `b` from the nearest point of `a`, each in its largest
/// component (one half of Hausdorff's distance of the two sets). Neither is empty; the cost is the product of sizes.
[[nodiscard]] double farthest_from(const PoincareSection& a, const PoincareSection& b);

/// How far two cycles of n points are apart: the largest difference of a component, at the best shift of one against
/// the other.
/// @param a, b       the points as rows, one after another; the last n of each are compared
/// @param columns    numbers in a row
/// @param dimension  as many of them are compared
/// @returns not a number if one has fewer than n rows
[[nodiscard]] double cycle_distance(std::span<const double> a, std::span<const double> b, std::size_t columns,
                                    std::size_t dimension, std::size_t n);

/// The largest range of a component.
[[nodiscard]] double extent(const PoincareSection& section);

/// Was a response without a period still converging to one? Its error is small and falls along the record.
/// @param tolerance  epsilon of recurrence()
[[nodiscard]] bool still_converging(const Recurrence& r, double tolerance);

/// @param longest    largest n of the search; at most half the record, so that each point is compared at least once
/// @param tolerance  epsilon, in the units of the state
[[nodiscard]] Recurrence recurrence(const PoincareSection& section, int longest, double tolerance);

}  // namespace epicyclic::analysis
