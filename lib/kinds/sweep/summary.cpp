#include "kinds/sweep/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/counted.hpp"
#include "core/largest_difference.hpp"
#include "core/text.hpp"
#include "gear/kinematics.hpp"
#include "reports/axis_words.hpp"
#include "reports/markdown.hpp"
#include "reports/transient_chaos.hpp"
#include "store/point_columns.hpp"

namespace epicyclic::kinds {

using namespace reports;

namespace {

using studies::Course;
using studies::PointSummary;

bool reached(const PointSummary& r) { return r.outcome == integrate::Outcome::reached; }

constexpr int place_digits = 6;  // of a value along the axis

std::string range_text(double from, double to, int digits, const AxisWords& words = {}) {
  return from == to ? words.text(from, digits) : words.text(from, digits) + " to " + words.text(to, digits);
}

/// The kept data of a point.
struct Place {
  double value = 0;
  std::string regime;  ///< or the status
  bool periodic = false;
  bool chaotic = false;
  bool comparable = false;              ///< reached, and converged if periodic
  bool classified = false;              ///< whether the regime is known, by more than recurrence
  std::array<bool, 2> loses_contact{};  ///< any of the sun meshes, of the ring meshes
  double sun_range = 0;
  std::vector<double> orbit{};  ///< a state of it at the section, if it is periodic by evidence
  std::size_t index = 0;        ///< of the point
};

Place place_of(const PointSummary& r) {
  Place p;
  p.value = r.point.value;
  p.regime = reached(r) ? regime_name(r) : store::status_word(r.outcome);
  p.periodic = reached(r) && r.regime == analysis::Regime::periodic;
  p.chaotic = reached(r) && r.regime == analysis::Regime::chaotic;
  p.comparable = reached(r) && !r.is_unconverged();
  p.classified = reached(r) && r.classified && r.regime != analysis::Regime::undecided;
  if (p.comparable) {
    p.sun_range = r.meshes.sun_planet.front().delta.range();
    p.loses_contact = {studies::StageRecord::loss_time(r.meshes.sun_planet) > 0.0,
                       studies::StageRecord::loss_time(r.meshes.ring_planet) > 0.0};
  }
  if (p.periodic) p.orbit = r.orbit;
  p.index = r.point.index;
  return p;
}

/// Neighbours from `first` on, `count` of them.
struct Run {
  std::size_t first = 0, count = 0;
};

/// Stretches whose members are alike.
/// @param alike  of two neighbours
std::vector<Run> runs(std::size_t count, const std::function<bool(std::size_t, std::size_t)>& alike) {
  std::vector<Run> all;
  for (std::size_t k = 0; k < count; ++k) {
    if (k > 0 && alike(k - 1, k))
      ++all.back().count;
    else
      all.push_back({k, 1});
  }
  return all;
}

/// Relative error of the largest forces that a reader should know of.
constexpr double force_error_limit = 0.02;

/// A number that a sweep has somewhere.
struct Largest {
  std::string what, unit;
  std::function<double(const PointSummary&)> of;
  bool of_stage = false;  ///< not of a pair of gears, which has no ring, and nothing to share loads with
  std::optional<double> value{};
  std::string at{};  ///< in words
};

std::vector<Largest> largest_of(bool pair) {
  const auto greatest = [](const std::vector<studies::MeshRecord>& meshes, auto number) {
    double most = 0.0;
    for (const studies::MeshRecord& mesh : meshes) most = std::max(most, number(mesh));
    return most;
  };
  const auto force = [](const Course& c) { return c.largest; };
  const std::string mesh = pair ? "the mesh" : "a sun mesh";
  std::vector<Largest> all = {
      // The first four are also in the short lines.
      {"dynamic factor K_v of " + mesh, "1",
       [](const PointSummary& r) { return studies::StageRecord::kv(r.meshes.sun_planet); }},
      {"dynamic factor K_v of a ring mesh", "1",
       [](const PointSummary& r) { return studies::StageRecord::kv(r.meshes.ring_planet); }, true},
      {"force of " + mesh + " over its static force F_0", "1",
       [](const PointSummary& r) { return r.meshes.dynamic_factor(r.meshes.sun_planet); }},
      {"force of a ring mesh over F_0 of a sun mesh", "1",
       [](const PointSummary& r) { return r.meshes.dynamic_factor(r.meshes.ring_planet); }, true},
      {"mesh load factor K_gamma of the sun meshes", "1",
       [](const PointSummary& r) { return studies::StageRecord::k_gamma(r.meshes.sun_planet); }, true},
      {"mesh load factor K_gamma of the ring meshes", "1",
       [](const PointSummary& r) { return studies::StageRecord::k_gamma(r.meshes.ring_planet); }, true},
      {"force of " + mesh, "N",
       [=](const PointSummary& r) {
         return greatest(r.meshes.sun_planet, [&](const auto& m) { return force(m.force); });
       }},
      {"force of a ring mesh", "N",
       [=](const PointSummary& r) {
         return greatest(r.meshes.ring_planet, [&](const auto& m) { return force(m.force); });
       },
       true},
      {pair ? "force of the bearing of gear 2" : "force of a planet's bearing", "N",
       [](const PointSummary& r) { return r.meshes.largest_bearing_force(); }},
      {"peak to peak of delta_sp_1", "b_c",
       [](const PointSummary& r) { return r.meshes.sun_planet.front().delta.range(); }},
      {"RMS of delta_sp_1", "b_c", [](const PointSummary& r) { return r.meshes.sun_planet.front().delta.rms; }},
      {"peak to peak of delta_rp_1", "b_c",
       [](const PointSummary& r) { return r.meshes.ring_planet.front().delta.range(); }, true},
      {"peak to peak of the transmission error", "b_c",
       [](const PointSummary& r) { return r.meshes.transmission_error.range(); }},
      {pair ? "time out of contact" : "time out of contact, sun mesh", "part of the time",
       [](const PointSummary& r) { return studies::StageRecord::loss_time(r.meshes.sun_planet); }},
      {"time out of contact, ring mesh", "part of the time",
       [](const PointSummary& r) { return studies::StageRecord::loss_time(r.meshes.ring_planet); }, true},
      {"mean mesh force of a planet, over the average of the planets", "1",
       [](const PointSummary& r) { return r.meshes.largest_share(); }, true},
      {"largest mesh force of a planet, over the average of the planets", "1",
       [](const PointSummary& r) { return r.meshes.largest_share(&Course::largest); }, true},
  };
  if (pair) std::erase_if(all, [](const Largest& l) { return l.of_stage; });
  return all;
}

/// The summary of a sweep.
class Summary {
 public:
  Summary(const SweepOutput& output, const studies::PointSource& points)
      : output_(output), words_(axis_words(output.sweep.axis.name, output.speed)), points_(points) {
    const auto& directions = output.sweep.directions;
    directions_.resize(directions.size());
    const std::size_t each = directions.empty() ? 0 : points.count / directions.size();
    for (std::size_t k = 0; k < points.count && each > 0; ++k) {
      const PointSummary r = points.read_summary(k);
      const std::size_t direction = std::min(k / each, directions.size() - 1);
      directions_[direction].push_back(place_of(r));
      failed_ += reached(r) ? 0 : 1;
      if (reached(r)) doubt(r);
      if (reached(r) && !r.is_unconverged()) see(r);
    }
    for (auto& places : directions_) std::ranges::sort(places, {}, &Place::value);
  }

  SweepSummary result() {
    SweepSummary s;
    s.text = fmt::format("# {}: results of the sweep\n\n", markdown_cell(output_.title));
    std::size_t points = 0;
    for (const auto& places : directions_) points += places.size();
    const studies::Axis& axis = output_.sweep.axis;
    s.text += fmt::format("{} points along `{}`, {} to {}", points, words_.name, place(axis.from), place(axis.to));
    if (words_.name != axis.name)
      s.text += fmt::format(" (`{}` {} to {})", axis.name, short_text(axis.from, place_digits),
                            short_text(axis.to, place_digits));
    for (std::size_t w = 0; w < directions_.size(); ++w) s.text += (w == 0 ? ", " : " and ") + word_of(w);
    s.text += failed_ > 0 ? fmt::format("; {} failed.\n", failed_) : std::string(".\n");
    s.text += windows();
    s.text += contact_loss();
    add_unlike(s);
    add_largest(s);
    add_doubts(s);
    return s;
  }

 private:
  const SweepOutput& output_;
  AxisWords words_;
  const studies::PointSource& points_;
  std::vector<std::vector<Place>> directions_;                                ///< of each direction, by rising value
  std::size_t failed_ = 0, undecided_ = 0, not_converged_ = 0, tensile_ = 0;  ///< points
  std::size_t coarse_ = 0;                                                    ///< points with uncertain largest forces
  double force_error_ = 0;                                                    ///< largest of the points
  double tensile_force_ = 0;  ///< largest tension, over the static mesh force
  double tensile_time_ = 0;   ///< largest part of the time
  std::vector<Largest> largest_ = largest_of(points_.count > 0 && points_.read_summary(0).meshes.is_pair());

  [[nodiscard]] std::string place(double value) const { return words_.text(value, place_digits); }

  [[nodiscard]] std::string word_of(std::size_t direction) const {
    return store::direction_word(output_.sweep.directions[direction]);
  }

  void doubt(const PointSummary& r) {
    undecided_ += r.regime == analysis::Regime::undecided ? 1 : 0;
    not_converged_ += r.is_unconverged() ? 1 : 0;
    force_error_ = std::max(force_error_, r.meshes.force_error);
    coarse_ += r.meshes.force_error > force_error_limit ? 1 : 0;
    if (!r.has_tension()) return;
    ++tensile_;
    for (const auto* meshes : {&r.meshes.sun_planet, &r.meshes.ring_planet}) {
      tensile_force_ = std::max(tensile_force_, studies::StageRecord::tension(*meshes));
      tensile_time_ = std::max(tensile_time_, studies::StageRecord::tension_time(*meshes));
    }
  }

  void see(const PointSummary& r) {
    for (Largest& one : largest_) {
      const double x = one.of(r);
      if (std::isnan(x) || (one.value && x <= *one.value)) continue;
      one.value = x;
      one.at = place(r.point.value);
      if (words_.name != output_.sweep.axis.name)
        one.at += fmt::format(" ({})", words_.name);
      else if (words_.name == studies::speed_parameter && std::isfinite(r.meshes.speeds.sun))
        one.at += fmt::format(" ({} {} rpm)", r.meshes.is_pair() ? "gear 1" : "sun",
                              short_text(gear::rpm * r.meshes.speeds.sun, 5));
      one.at += fmt::format(", {}, {}", store::direction_word(r.point.direction), regime_name(r));
    }
  }

  [[nodiscard]] std::string windows() const {
    constexpr std::size_t fewest = 3;
    constexpr std::size_t listed = 24;
    std::string rows;
    std::size_t between = 0;
    std::string others;
    for (std::size_t w = 0; w < directions_.size(); ++w) {
      const std::vector<Place>& places = directions_[w];
      for (const Run& run :
           runs(places.size(), [&](std::size_t a, std::size_t b) { return places[a].regime == places[b].regime; })) {
        if (run.count < fewest) {
          for (std::size_t k = run.first; k < run.first + run.count; ++k)
            if (++between <= listed)
              others += fmt::format("{}{} ({}, {})", others.empty() ? "" : ", ", place(places[k].value), word_of(w),
                                    places[k].regime);
          continue;
        }
        rows += fmt::format("| {} | {} | {} | {} | {} |\n", word_of(w), places[run.first].regime,
                            place(places[run.first].value), place(places[run.first + run.count - 1].value), run.count);
      }
    }
    std::string text = "\n## Windows\n\nEach row is at least three neighbouring points of one regime and period";
    if (between > listed) others += fmt::format(" and {} more", between - listed);
    text += between > 0 ? fmt::format(". {} between the windows, alone or in pairs: {}.\n",
                                      counted(between, "points lie", "point lies"), others)
                        : std::string(".\n");
    if (rows.empty()) return text;
    return text + "\n| direction | regime | from | to | points |\n|---|---|---|---|---|\n" + rows;
  }

  /// Ranges of values at which meshes lose contact.
  [[nodiscard]] std::string contact_loss() const {
    std::string rows;
    for (std::size_t mesh = 0; mesh < 2; ++mesh)
      for (std::size_t w = 0; w < directions_.size(); ++w) {
        const std::vector<Place>& places = directions_[w];
        for (const Run& run : runs(places.size(), [&](std::size_t a, std::size_t b) {
               return places[a].loses_contact[mesh] == places[b].loses_contact[mesh];
             }))
          if (places[run.first].loses_contact[mesh])
            rows +=
                fmt::format("| {} | {} | {} | {} | {} |\n", mesh == 0 ? "sun-planet" : "ring-planet", word_of(w),
                            place(places[run.first].value), place(places[run.first + run.count - 1].value), run.count);
      }
    if (rows.empty()) return "\n## Contact loss\n\nNo mesh loses contact at a point.\n";
    return "\n## Contact loss\n\nAt these values a mesh of any planet is out of contact for a part of the time.\n\n"
           "| mesh | direction | from | to | points |\n|---|---|---|---|---|\n" +
           rows;
  }

  /// Are they known to be two attractors? One of them is then periodic. Records of finite length do not distinguish two
  /// tori or two chaotic attractors.
  [[nodiscard]] bool are_unlike(const Place& a, const Place& b) const {
    if (!a.classified || !b.classified || (!a.periodic && !b.periodic)) return false;
    if (a.regime != b.regime) return true;
    // Two records may converge to one orbit for long: each is then as near to the other's orbit as to its own.
    constexpr double apart = 1e-3;  // [b_c, b_c per tau]
    constexpr double times = 10.0;
    if (a.orbit.empty() || a.orbit.size() != b.orbit.size()) return false;
    if (largest_difference(a.orbit, b.orbit) <= apart) return false;
    const studies::PointResult record = points_.read(b.index);
    return distance(record, a.orbit) > apart + times * distance(record, b.orbit);
  }

  /// Of an orbit's state from the nearest one of a record.
  static double distance(const studies::PointResult& record, const std::vector<double>& orbit) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t row = 0; row < record.poincare_rows(); ++row)
      least =
          std::min(least, largest_difference(orbit, std::span(record.poincare).subspan(row * record.poincare_columns)));
    return least;
  }

  void add_unlike(SweepSummary& s) const {
    if (directions_.size() != 2 || directions_[0].size() != directions_[1].size()) return;
    const std::vector<Place>& up = directions_[0];
    const std::vector<Place>& down = directions_[1];
    std::size_t values = 0;
    std::size_t chaotic = 0;
    std::size_t not_compared = 0;
    std::string rows;
    std::vector<std::pair<double, double>> stretches;  // with one pair of attractors or several, next to each other
    std::vector<bool> unlike;
    for (std::size_t k = 0; k < up.size(); ++k) unlike.push_back(are_unlike(up[k], down[k]));
    const auto alike = [&](std::size_t a, std::size_t b) {
      return unlike[a] == unlike[b] &&
             (!unlike[a] || (up[a].regime == up[b].regime && down[a].regime == down[b].regime));
    };
    for (const Run& run : runs(up.size(), alike)) {
      const std::size_t last = run.first + run.count - 1;
      if (!unlike[run.first]) {
        for (std::size_t k = run.first; k <= last; ++k)
          not_compared += up[k].classified && down[k].classified && up[k].periodic && down[k].periodic ? 0 : 1;
        continue;
      }
      values += run.count;
      if (up[run.first].chaotic || down[run.first].chaotic) chaotic += run.count;
      if (run.first > 0 && unlike[run.first - 1])
        stretches.back().second = up[last].value;
      else
        stretches.emplace_back(up[run.first].value, up[last].value);
      const auto extents = [&](const std::vector<Place>& places) {
        std::vector<double> there;
        for (std::size_t k = run.first; k <= last; ++k)
          if (places[k].comparable) there.push_back(places[k].sun_range);
        if (there.empty()) return std::string("not converged");
        return range_text(std::ranges::min(there), std::ranges::max(there), 3);
      };
      rows += fmt::format("| {} | {} | {} | {} | {} |\n",
                          range_text(up[run.first].value, up[last].value, place_digits, words_), up[run.first].regime,
                          down[run.first].regime, extents(up), extents(down));
    }
    const std::string first = word_of(0);
    const std::string second = word_of(1);
    s.text += fmt::format("\n## {} and {}\n\n", first == "up" ? "Up" : "Down", second);
    s.numbers["unlike"] = {{"values", values}, {"of", up.size()}, {"one_chaotic", chaotic}};
    if (values == 0) {
      s.text += "No value is known at which two attractors coexist";
    } else {
      s.text += fmt::format("At {} of {} values two attractors coexist", values, up.size());
      std::string list;
      constexpr std::size_t most = 4;
      for (std::size_t k = 0; k < std::min(most, stretches.size()); ++k)
        list += (k == 0 ? "" : ", ") + range_text(stretches[k].first, stretches[k].second, place_digits, words_);
      if (stretches.size() > most) list += fmt::format(" and {} more", stretches.size() - most);
      s.lines.push_back(fmt::format("two attractors coexist at {} of {} values: {}", values, up.size(), list));
      if (chaotic > 0) {
        const std::string where = chaotic == values ? "there" : fmt::format("at {} of these", chaotic);
        s.text += fmt::format(". One of them is chaotic {}: {}", where, transient_chaos);
        s.lines.back() += fmt::format("; {} one is chaotic and may be a long transient", where);
      }
    }
    if (not_compared > 0)
      s.text +=
          fmt::format(". At {} the comparison is not possible: neither attractor is periodic, or one is not classified",
                      counted(not_compared, "values", "value"));
    s.text += ".\n";
    if (!rows.empty())
      s.text +=
          fmt::format(
              "\n| value | {0} | {1} | peak to peak of delta_sp_1, {0} [b_c] | {1} [b_c] |\n|---|---|---|---|---|\n",
              first, second) +
          rows;
  }

  void add_largest(SweepSummary& s) const {
    std::string rows;
    for (const Largest& one : largest_)
      if (one.value)
        rows += fmt::format("| {} | {} | {} | {} |\n", one.what, short_text(*one.value, 4), one.unit, one.at);
    if (rows.empty()) return;
    s.text +=
        "\n## Largest values\n\nOf the records. A chaotic record gives the largest value of that record only.\n\n"
        "| what | value | unit | where |\n|---|---|---|---|\n" +
        rows;
    bool has_line = false;
    const auto add_line = [&](const Largest& sun, const Largest& ring, const char* number) {
      const Largest& more = ring.value.value_or(0.0) > sun.value.value_or(0.0) ? ring : sun;
      if (!more.value) return;
      if (!std::exchange(has_line, true))
        s.lines.push_back(fmt::format("largest {}: {} at {}", more.what, short_text(*more.value, 4), more.at));
      s.numbers[number] = *more.value;
    };
    // Of the sun meshes and, of a stage, of the ring meshes.
    const std::size_t kinds = largest_[1].of_stage ? 2 : 1;
    add_line(largest_[0], largest_[kinds - 1], "largest_kv");
    add_line(largest_[kinds], largest_[2 * kinds - 1], "largest_dynamic_factor");
  }

  void add_doubts(SweepSummary& s) const {
    std::string text;
    if (undecided_ > 0)
      text += fmt::format("- {}: the evidence proves no regime (column `evidence` of points.csv).\n",
                          counted(undecided_, "points are undecided", "point is undecided"));
    if (not_converged_ > 0)
      text += fmt::format(
          "- {} periodic, but the record has not converged to the orbit, or is shorter than its period (`converged` is "
          "0 in points.csv). The Poincaré points, means, RMS values and extrema are not those of the orbit. Use a "
          "larger "
          "/study/transient_periods or \"transient\": \"adaptive\".\n",
          counted(not_converged_, "points are", "point is"));
    if (tensile_ > 0)
      text += fmt::format(
          "- {} a tensile mesh force, of up to {:.3g} times the static mesh force and for up to {:.1f} % of the time "
          "(`tensile_force_sp`, `tensile_force_rp`, `tensile_time_sp` and `tensile_time_rp` in points.csv). Real teeth "
          "transmit no tension: the force is that of the mesh damping. Compare with \"gap_damping\": \"contact_slope\" "
          "in "
          "/model and \"clearance_smoothing\": 0.01 in /integrator: K_v can differ by a factor of two and more. See "
          "docs/reference/model_options.md.\n",
          counted(tensile_, "points have", "point has"), tensile_force_, 100.0 * tensile_time_);
    if (coarse_ > 0)
      text += fmt::format(
          "- At {} the largest forces and K_v are uncertain by more than {:.0f} %, by up to about {:.2g} % "
          "(`force_max_error` in points.csv): peaks between two samples are missed. Use a larger "
          "/study/output_phases.\n",
          counted(coarse_, "points", "point"), 100.0 * force_error_limit, 100.0 * force_error_);
    if (!text.empty()) s.text += "\n## Not certain\n\n" + text;
  }
};

}  // namespace

SweepSummary sweep_summary(const SweepOutput& output, const studies::PointSource& points) {
  return Summary(output, points).result();
}

}  // namespace epicyclic::kinds
