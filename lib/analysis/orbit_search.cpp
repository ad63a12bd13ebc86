#include "analysis/orbit_search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <exception>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "analysis/attractors.hpp"
#include "analysis/branch_switching.hpp"
#include "analysis/shooting.hpp"
#include "core/dense.hpp"
#include "core/errors.hpp"
#include "core/random_numbers.hpp"
#include "core/require.hpp"
#include "core/text.hpp"

namespace epicyclic::analysis {

namespace {

/// Calls f(0) ... f(count - 1) by some threads; of exceptions the one of the least number goes on.
template <class F>
void for_each_index(std::size_t count, int threads, F&& f) {
  std::vector<std::exception_ptr> thrown(count);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        f(i);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
    }
  };
  std::vector<std::thread> others;
  for (int k = 1; k < threads; ++k) others.emplace_back(work);
  work();
  for (std::thread& t : others) t.join();
  for (const std::exception_ptr& e : thrown)
    if (e) std::rethrow_exception(e);
}

/// The family's orbits of period n.
OrbitFamily of_period(const OrbitFamily& family, int n) {
  OrbitFamily f = family;
  f.period = n;
  f.shooting_intervals *= n;
  return f;
}

double states_length(const OrbitFamily& family, const Eigen::MatrixXd& states) {
  return std::sqrt(states.squaredNorm() / static_cast<double>(states.size())) / family.state_scale;
}

/// Newton's steps at one place, with the states of all shooting intervals condensed to y_0.
class Linearised {
 public:
  Linearised(const Eigen::MatrixXd& kept, const Shot& shot) : kept_(kept) {
    const Eigen::Index m = kept.cols();
    matrix_ = Eigen::MatrixXd::Identity(m, m);
    for (const Eigen::MatrixXd& interval_map : shot.interval_maps) {
      shooting_intervals_.push_back(product(transposed_product(kept, interval_map), kept));
      matrix_ = product(shooting_intervals_.back(), matrix_);
    }
    matrix_ = Eigen::MatrixXd::Identity(m, m) - matrix_;
  }

  /// d with M_i d_i - d_i+1 = -r_i.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& r) const {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(kept_.cols());
    const auto advance = [&](Eigen::Index i) {
      d = shooting_intervals_[static_cast<std::size_t>(i)] * d + kept_.transpose() * r.col(i);
    };
    for (Eigen::Index i = 0; i < r.cols(); ++i) advance(i);
    d = solution(matrix_, d);
    Eigen::MatrixXd all(kept_.rows(), r.cols());
    for (Eigen::Index i = 0; i < r.cols(); ++i) {
      all.col(i) = kept_ * d;
      advance(i);
    }
    return all;
  }

 private:
  const Eigen::MatrixXd& kept_;
  std::vector<Eigen::MatrixXd> shooting_intervals_;
  Eigen::MatrixXd matrix_;  ///< I - M
};

/// m of [A-deflate]; of no orbits it is 1.
class Deflation {
 public:
  Deflation(const OrbitFamily& family, std::vector<Eigen::VectorXd> known)
      : scale_(family.state_scale), known_(std::move(known)) {}

  [[nodiscard]] double log_value(const Eigen::VectorXd& y) const {
    double sum = 0.0;
    for (const Eigen::VectorXd& a : known_) sum += std::log1p(1.0 / square(y - a));
    return sum;
  }

  /// grad(log m) . v
  [[nodiscard]] double slope(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
    double sum = 0.0;
    for (const Eigen::VectorXd& a : known_) {
      const double r2 = square(y - a);
      sum -= 2.0 * product(y - a, v) / (r2 * (1.0 + r2));
    }
    return sum;
  }

 private:
  [[nodiscard]] double product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    return a.dot(b) / (static_cast<double>(a.size()) * scale_ * scale_);
  }
  // At an orbit itself m has a pole: of the least number its logarithm is finite.
  [[nodiscard]] double square(const Eigen::VectorXd& v) const {
    return std::max(product(v, v), std::numeric_limits<double>::min());
  }

  double scale_;
  std::vector<Eigen::VectorXd> known_;
};

/// Result of Newton's method from one start.
struct NewtonRun {
  std::optional<BranchOrbit> orbit;
  SearchFailure why = SearchFailure::no_descent;
  std::string message;
  long evaluations = 0;
};

/// The damped method from one state, by a flow of its own.
NewtonRun follow(const OrbitFamily& family, double value, const Eigen::VectorXd& start, const Deflation& deflation,
                 const SearchOptions& options) {
  NewtonRun run;
  const auto failed = [&](SearchFailure why, std::string message) {
    run.why = why;
    run.message = std::move(message);
    return run;
  };
  const auto flow = family.flows(value);
  const Eigen::MatrixXd kept = kept_states(family, start.size());
  const auto keep = [&](const Eigen::MatrixXd& states) { return product(kept, transposed_product(kept, states)); };
  Eigen::MatrixXd y(start.size(), family.shooting_intervals);
  y.col(0) = keep(start);
  if (const integrate::Evolution e = integrate_to_intervals(*flow, family.period, y); !e.reached())
    return failed(SearchFailure::not_integrated, e.message);
  y = keep(y);
  double damping = 1.0;
  int jumps = 0;
  for (int k = 0; k < options.iterations; ++k) {
    const Shot shot = shoot(*flow, y, family.period);
    ++run.evaluations;
    if (!shot.evolution.reached()) return failed(SearchFailure::not_integrated, shot.evolution.message);
    const Linearised linearised(kept, shot);
    const Eigen::MatrixXd d = linearised.solve(shot.residual);
    if (!d.allFinite()) return failed(SearchFailure::no_descent, "the equations are singular");
    // From here Newton's method needs no damping.
    constexpr double near = 1e-4;
    if (states_length(family, d) <= near) {
      Correction c = correct_at(family, value, y);
      if (!c.found) return failed(SearchFailure::not_corrected, c.message);
      run.orbit = std::move(c.orbit);
      return run;
    }
    const Eigen::VectorXd at = y.col(0);
    const double log_m = deflation.log_value(at);
    const double factor = 1.0 / (1.0 - deflation.slope(at, d.col(0)));
    const Eigen::MatrixXd step = factor * d;
    const double level = states_length(family, step);
    if (!std::isfinite(level)) return failed(SearchFailure::no_descent, "the deflated equations are singular");
    const double longest = std::min(1.0, options.max_step / level);
    damping = std::min(longest, 2.0 * damping);
    // If the equations are nearly singular, steps are long: the least one is a part of the longest one allowed.
    const double least = options.least_damping * damping;
    std::optional<Eigen::MatrixXd> next;
    for (; !next && damping >= least; damping *= 0.5) {
      Eigen::MatrixXd trial = y + damping * step;
      const Shot there = shoot_states(*flow, trial, family.period);
      if (!there.evolution.reached()) continue;
      // Newton's step for G from there, by the matrix of here.
      const Eigen::MatrixXd q = linearised.solve(there.residual);
      const Eigen::MatrixXd of_g = q + (factor * deflation.slope(at, q.col(0))) * d;
      const double grown = std::exp(deflation.log_value(trial.col(0)) - log_m);
      if (grown * states_length(family, of_g) > (1.0 - 0.25 * damping) * level) continue;
      next = std::move(trial);
      damping *= 2.0;
    }
    if (!next) {
      // Near a singular place damped steps end, and one that is not damped may lead across.
      if (++jumps > options.jumps)
        return failed(SearchFailure::no_descent,
                      "no step falls at a residual of " + short_text(shot.residual.lpNorm<Eigen::Infinity>()));
      damping = longest;
      next = y + longest * step;
    }
    y = *std::move(next);
  }
  return failed(SearchFailure::iterations, "not at an orbit after " + std::to_string(options.iterations) + " steps");
}

/// A start, and the states of its trajectory at the beginnings of periods.
struct Trajectory {
  std::vector<Eigen::VectorXd> states;

  /// The states from which n periods lead nearest to themselves, the nearest first, no more than `most`.
  [[nodiscard]] std::vector<Eigen::VectorXd> closest_returns(const Eigen::MatrixXd& kept, std::size_t n,
                                                             std::size_t most) const {
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t k = 0; k + n < states.size(); ++k)
      near.emplace_back((kept.transpose() * (states[k + n] - states[k])).norm(), k);
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), most));
    std::vector<Eigen::VectorXd> found;
    for (const auto& [distance, k] : near) found.push_back(states[k]);
    return found;
  }
};

Trajectory trajectory_from(const OrbitFamily& family, double value, const std::vector<double>& start, int periods) {
  Trajectory m;
  std::vector<double> y = start;
  const auto keep_state = [&] {
    m.states.emplace_back(Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size())));
  };
  keep_state();
  const auto flow = family.flows(value);
  for (int k = 0; k < periods; ++k) {
    if (!flow->evolve(y, 0.0, flow->field().period).reached()) break;  // as far as it goes
    keep_state();
  }
  return m;
}

/// Of the orbit as [A-same] compares it.
/// @param once  how often it is gone through
AttractorRecord record_of(const Eigen::MatrixXd& states, double error, int once = 1) {
  AttractorRecord r;
  r.regime = Regime::periodic;
  r.dimension = static_cast<std::size_t>(states.rows());
  for (int k = 0; k < once; ++k) r.orbit.insert(r.orbit.end(), states.data(), states.data() + states.size());
  r.orbit_error = error;
  return r;
}

bool are_one(const AttractorRecord& a, const AttractorRecord& b) {
  return label_attractors(std::vector<AttractorRecord>{a, b}).all.size() == 1;
}

AttractorRecord rotated(const AttractorRecord& record, const Eigen::MatrixXd& map) {
  AttractorRecord r = record;
  const auto n = static_cast<Eigen::Index>(r.dimension);
  for (std::size_t k = 0; k < r.period(); ++k) {
    Eigen::Map<Eigen::VectorXd> y(r.orbit.data() + k * r.dimension, n);
    y = Eigen::VectorXd(map * y);
  }
  return r;
}

/// An orbit that a start led to.
struct Candidate {
  OrbitFamily family;
  BranchOrbit orbit;
  Eigen::MatrixXd states;  ///< at the beginnings of its periods
  double error = 0;        ///< e of [A-same]
  std::size_t start = 0;
};

/// @returns nothing if the integration failed
std::optional<Candidate> candidate(const OrbitFamily& family, const BranchOrbit& orbit, double map_error) {
  Candidate c{family, orbit, period_states(family, orbit.at), 0.0, 0};
  if (c.states.cols() == 0) return std::nullopt;
  const double largest = c.states.lpNorm<Eigen::Infinity>();
  c.error = orbit_error(orbit.monodromy.product(), std::max(orbit.residual, map_error * largest));
  return c;
}

/// The orbit at its least period.
Candidate at_least_period(const OrbitFamily& system, Candidate c, double map_error) {
  const int n = c.family.period;
  const double largest = c.states.lpNorm<Eigen::Infinity>();
  for (int d = 1; d < n; ++d) {
    if (n % d != 0) continue;
    // An orbit that is not nearly closed after d periods does not have the period d.
    constexpr double comes_back = 1e-2;
    if (!((c.states.col(d) - c.states.col(0)).lpNorm<Eigen::Infinity>() <= comes_back * largest)) continue;
    const OrbitFamily shorter = of_period(system, d);
    const Eigen::VectorXd y = c.states.col(0);
    const Correction found = first_orbit(shorter, c.orbit.at.value, {y.data(), static_cast<std::size_t>(y.size())});
    if (!found.found) continue;
    std::optional<Candidate> once = candidate(shorter, found.orbit, map_error);
    if (once && are_one(record_of(once->states, once->error, n / d), record_of(c.states, c.error))) {
      once->start = c.start;
      return *std::move(once);
    }
  }
  return c;
}

/// Results of one start's runs of one kind.
struct StartRuns {
  std::vector<Candidate> led_to;
  SearchFailure why = SearchFailure::no_descent;  ///< of the last one that failed
  std::string message;
  long evaluations = 0;
};

bool lexicographically_less(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// Different ones of what was found, images of each other one, in their order.
std::vector<FoundOrbit> distinct_orbits(const OrbitFamily& system, const std::vector<Candidate>& candidates) {
  const CyclicSymmetry symmetry = system.symmetry.map.size() != 0 ? system.symmetry : CyclicSymmetry{};
  std::vector<Eigen::MatrixXd> rotations;
  std::vector<Symmetry> maps;
  for (int k = 1; k < symmetry.order; ++k) {
    rotations.emplace_back(k == 1 ? symmetry.map : Eigen::MatrixXd(symmetry.map * rotations.back()));
    maps.emplace_back([rotation = rotations.back()](std::span<const double> y) {
      std::vector<double> image(y.size());
      Eigen::Map<Eigen::VectorXd>(image.data(), rotation.rows()) =
          rotation * Eigen::Map<const Eigen::VectorXd>(y.data(), rotation.cols());
      return image;
    });
  }
  std::vector<AttractorRecord> records;
  for (const Candidate& c : candidates) records.push_back(record_of(c.states, c.error));
  const Attractors attractors = label_attractors(records, {}, maps);

  // The first attractor that each one is an image of.
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t a = 0; a < attractors.all.size(); ++a) {
    std::size_t first = a;
    while (attractors.all[first].image_of != 0) first = attractors.all[first].image_of - 1;
    auto& of = members[first];
    of.insert(of.end(), attractors.all[a].members.begin(), attractors.all[a].members.end());
  }

  std::vector<FoundOrbit> found;
  for (const auto& [first, of] : members) {
    const Candidate& c = candidates[*std::min_element(of.begin(), of.end(), [&](std::size_t a, std::size_t b) {
      return lexicographically_less(candidates[a].states.col(0), candidates[b].states.col(0));
    })];
    FoundOrbit f{c.family, c.orbit, 1, 0, 0.0, {}};
    for (const std::size_t k : of) f.starts.push_back(candidates[k].start);
    std::sort(f.starts.begin(), f.starts.end());
    f.starts.erase(std::unique(f.starts.begin(), f.starts.end()), f.starts.end());
    if (!rotations.empty()) {
      std::vector<AttractorRecord> images = {record_of(c.states, c.error)};
      for (const Eigen::MatrixXd& rotation : rotations) images.push_back(rotated(images.front(), rotation));
      f.images = static_cast<int>(label_attractors(images).all.size());
      // A travelling disturbance is the same orbit rotated, begun at another period: the symmetry does not keep its
      // states.
      const AttractorRecord state = record_of(c.states.leftCols(1), c.error);
      f.family.keeps_symmetry = are_one(state, rotated(state, symmetry.map));
      if (f.family.keeps_symmetry && !c.family.keeps_symmetry) {
        Correction kept = correct_at(f.family, c.orbit.at.value, c.orbit.at.states);
        if (kept.found) f.orbit = std::move(kept.orbit);
        if (!kept.found) f.family.keeps_symmetry = false;
      }
    }
    for (const std::complex<double>& x : multipliers_of(f.family, f.orbit.monodromy)) {
      f.unstable += std::abs(x) > 1.0 ? 1 : 0;
      f.multiplier_max = std::max(f.multiplier_max, std::abs(x));
    }
    found.push_back(std::move(f));
  }
  std::sort(found.begin(), found.end(), [](const FoundOrbit& a, const FoundOrbit& b) {
    if (a.family.period != b.family.period) return a.family.period < b.family.period;
    return lexicographically_less(a.orbit.at.states.col(0), b.orbit.at.states.col(0));
  });
  return found;
}

/// All known orbits whose periods divide n, begun at each of their periods and rotated by the symmetry.
Deflation known_of(const OrbitFamily& family, const std::vector<FoundOrbit>& found) {
  const CyclicSymmetry& symmetry = family.symmetry;
  std::vector<Eigen::VectorXd> known;
  for (const FoundOrbit& f : found) {
    if (family.period % f.family.period != 0) continue;
    Eigen::MatrixXd states = period_states(f.family, f.orbit.at);
    const int rotations = symmetry.map.size() != 0 && !f.keeps_symmetry() ? symmetry.order : 1;
    for (int k = 0; k < rotations; ++k) {
      if (k > 0) states = symmetry.map * states;
      for (Eigen::Index i = 0; i < states.cols(); ++i) known.emplace_back(states.col(i));
    }
  }
  return {family, std::move(known)};
}

}  // namespace

void SearchOptions::validate() const {
  require(smallest_period >= 1, "smallest_period", smallest_period, ">= 1");
  require(largest_period >= smallest_period, "largest_period", largest_period, ">= smallest_period");
  require(return_periods >= 0, "settle", return_periods, ">= 0");
  require(returns >= 1, "returns", returns, ">= 1");
  require(rounds >= 0, "rounds", rounds, ">= 0");
  require(iterations >= 1, "iterations", iterations, ">= 1");
  require(jumps >= 0, "jumps", jumps, ">= 0");
  require(least_damping > 0.0 && least_damping <= 1.0, "least_damping", least_damping, "in (0, 1]");
  require(max_step > 0.0, "max_step", max_step, "> 0");
  require(map_error >= 0.0, "map_error", map_error, ">= 0");
  require(threads >= 1, "threads", threads, ">= 1");
}

std::string to_string(SearchFailure failure) {
  switch (failure) {
    case SearchFailure::not_integrated:
      return "not_carried";
    case SearchFailure::no_descent:
      return "no_descent";
    case SearchFailure::iterations:
      return "iterations";
    case SearchFailure::not_corrected:
      break;
  }
  return "not_corrected";
}

OrbitSearch search_orbits(const OrbitFamily& family, double value, std::span<const std::vector<double>> starts,
                          const SearchOptions& options) {
  family.validate();
  options.validate();
  const std::size_t dimension = family.flows(value)->field().dimension;
  for (const std::vector<double>& start : starts)
    if (start.size() != dimension)
      throw InputError("a start of " + std::to_string(start.size()) + " numbers for a flow of " +
                       std::to_string(dimension));
  if (!starts.empty()) check_neutral(family, value, starts.front());
  const std::size_t count = starts.size();
  std::vector<Trajectory> trajectories(count);
  for_each_index(count, options.threads, [&](std::size_t i) {
    trajectories[i] = trajectory_from(family, value, starts[i], options.return_periods);
  });

  OrbitSearch result;
  std::vector<Candidate> candidates;
  for (int n = options.smallest_period; n <= options.largest_period; ++n) {
    const OrbitFamily of_n = of_period(family, n);
    const Eigen::MatrixXd kept = kept_states(of_n, static_cast<Eigen::Index>(dimension));
    std::vector<StartRuns> first(count);  // of each start without deflation
    std::vector<bool> led(count, false);
    // Starts as they are, then where they come back, then with what is known taken out.
    for (int round = -1; round <= options.rounds; ++round) {
      if (round == 0 && options.return_periods == 0) continue;
      const Deflation deflation = round > 0 ? known_of(of_n, result.orbits) : Deflation(of_n, {});
      std::vector<StartRuns> runs(count);
      for_each_index(count, options.threads, [&](std::size_t i) {
        std::vector<Eigen::VectorXd> from = {trajectories[i].states.front()};
        if (round == 0)
          from = trajectories[i].closest_returns(kept, static_cast<std::size_t>(n),
                                                 static_cast<std::size_t>(options.returns));
        for (const Eigen::VectorXd& y : from) {
          NewtonRun run = follow(of_n, value, y, deflation, options);
          runs[i].evaluations += run.evaluations;
          runs[i].why = run.why;
          runs[i].message = std::move(run.message);
          if (!run.orbit) continue;
          if (std::optional<Candidate> there = candidate(of_n, *run.orbit, options.map_error)) {
            there->start = i;
            runs[i].led_to.push_back(at_least_period(family, *std::move(there), options.map_error));
          }
        }
      });
      for (std::size_t i = 0; i < count; ++i) {
        result.evaluations += runs[i].evaluations;
        led[i] = led[i] || !runs[i].led_to.empty();
        std::move(runs[i].led_to.begin(), runs[i].led_to.end(), std::back_inserter(candidates));
        if (round < 0) first[i] = std::move(runs[i]);
      }
      const std::size_t before = result.orbits.size();
      result.orbits = distinct_orbits(family, candidates);
      if (round > 0 && result.orbits.size() == before) break;
    }
    for (std::size_t i = 0; i < count; ++i)
      if (!led[i]) result.missed.push_back({i, n, first[i].why, first[i].message});
  }
  return result;
}

std::vector<std::vector<double>> starts_in_box(std::span<const double> centre, std::span<const double> half_widths,
                                               std::size_t count, std::uint64_t seed) {
  if (half_widths.size() != centre.size())
    throw InputError(std::to_string(half_widths.size()) + " half widths for a state of " +
                     std::to_string(centre.size()) + " numbers");
  for (const double h : half_widths) require(h >= 0.0, "half width", h, ">= 0");
  std::uint64_t n = 0;
  std::vector<std::vector<double>> starts;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> y(centre.begin(), centre.end());
    if (k > 0)
      for (std::size_t j = 0; j < y.size(); ++j) y[j] += half_widths[j] * (2.0 * random_uniform(seed, ++n) - 1.0);
    starts.push_back(std::move(y));
  }
  return starts;
}

}  // namespace epicyclic::analysis
