#include "studies/loci.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/errors.hpp"
#include "core/require.hpp"
#include "core/text.hpp"
#include "integrate/make_flow.hpp"

namespace epicyclic::studies {

namespace {

using analysis::LocusEnd;
using analysis::LocusPoint;
using analysis::LocusTrace;

analysis::PlaneOfFlows flows_of(const ModelOverPlane& models, const integrate::IntegratorOptions& o) {
  return [models, o](double first, double second) { return integrate::make_flow(models(first, second), o); };
}

LocusRow row_of(const LocusPoint& p, std::string marked) {
  const auto state = p.at.states.col(0);
  return {p.first(), p.second(), p.first_bound, p.second_bound, std::move(marked), {state.begin(), state.end()}};
}

const char* end_word(LocusEnd end) {
  switch (end) {
    case LocusEnd::range:
      return "range";
    case LocusEnd::closed:
      return "closed";
    case LocusEnd::many:
      return "many";
    case LocusEnd::min_step:
      return "min_step";
    case LocusEnd::resonance:
      return "resonance";
    case LocusEnd::none:
      break;
  }
  return "";
}

/// A range of the second parameter, and a value in it.
struct SecondRange {
  double from = 0, to = 0, value = 0;
};

/// What a locus of a branch's points is traced on and with.
std::pair<analysis::OrbitSurface, analysis::LocusOptions> plane_of(const ModelOverPlane& models,
                                                                   const analysis::Branch& branch, double first,
                                                                   const SecondRange& second,
                                                                   const BranchesOptions& options, int points) {
  const auto at = [&, contacts = models(first, second.value).surfaces.count > 0](double tolerance) {
    return flows_of(models, branch_integrator(options.method, tolerance, contacts));
  };
  analysis::OrbitSurface surface;
  surface.flows = at(options.tolerance);
  surface.family = branch.family;
  surface.family.value_scale = options.to - options.from;
  surface.second_scale = second.to - second.from;
  analysis::LocusOptions o;
  o.along.from = options.from;
  o.along.to = options.to;
  o.along.max_step = options.max_step;
  o.along.first_step = std::min(o.along.first_step, options.max_step);
  o.along.orbits = static_cast<std::size_t>(points);
  o.second_from = second.from;
  o.second_to = second.to;
  const auto finer = at(0.1 * options.tolerance);
  o.others = {{finer, 1}, {finer, 2}};
  return {std::move(surface), std::move(o)};
}

}  // namespace

void LociOptions::validate() const {
  require(from < to, "to", to, "> from");
  require(points >= 1, "points", points, ">= 1");
  if (kinds.empty()) throw InputError("kinds is empty, must have one at least");
}

std::vector<std::size_t> points_of_loci(const TracedBranches& traced, const LociOptions& options) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < traced.special.size(); ++k) {
    const SpecialRow& r = traced.special[k];
    const bool has_locus = r.kind != analysis::SpecialKind::branch_point || !r.broken_symmetry.empty();
    if (std::ranges::find(options.kinds, r.kind) != options.kinds.end() && has_locus && !r.same_as) all.push_back(k);
  }
  if (options.near.empty()) return all;
  std::vector<std::size_t> nearest;
  for (const double value : options.near) {
    const auto best =
        std::ranges::min_element(all, {}, [&](std::size_t k) { return std::abs(traced.special[k].value - value); });
    if (best != all.end() && std::ranges::find(nearest, *best) == nearest.end()) nearest.push_back(*best);
  }
  return nearest;
}

bool is_on_a_locus(const std::vector<TracedLocus>& loci, const TracedBranches& traced, const SpecialRow& point,
                   double second, const BranchesOptions& options) {
  const analysis::Branch& branch = traced.branches[point.branch];
  const analysis::SpecialPoint& special = branch.special[point.point];
  const auto y = special.orbit.at.states.col(0);
  // Between rows a locus is taken as straight.
  constexpr double part_of_range = 1e-3;
  constexpr double state = 0.05;
  for (const TracedLocus& locus : loci) {
    if (locus.kind != point.kind || locus.period != point.period || locus.symmetry_index != special.symmetry_index)
      continue;
    for (std::size_t k = 0; k + 1 < locus.rows.size(); ++k) {
      const LocusRow& a = locus.rows[k];
      const LocusRow& b = locus.rows[k + 1];
      if ((a.second - second) * (b.second - second) > 0.0 || a.second == b.second) continue;
      const double part = (second - a.second) / (b.second - a.second);
      if (std::abs(a.first + part * (b.first - a.first) - point.value) > part_of_range * (options.to - options.from))
        continue;
      double most = 0.0;
      for (std::size_t j = 0; j < a.state.size(); ++j)
        most =
            std::max(most, std::abs(a.state[j] + part * (b.state[j] - a.state[j]) - y(static_cast<Eigen::Index>(j))));
      if (most <= state) return true;
    }
  }
  return false;
}

TracedLocus trace_locus(const ModelOverPlane& models, const TracedBranches& traced, const SpecialRow& point,
                        double second, const BranchesOptions& options) {
  const LociOptions& wanted = options.loci.value();
  wanted.validate();
  const analysis::Branch& branch = traced.branches[point.branch];
  const analysis::SpecialPoint& special = branch.special[point.point];
  TracedLocus result;
  result.branch = point.branch;
  result.point = point.point;
  result.kind = point.kind;
  result.period = point.period;
  result.symmetry_index = special.symmetry_index;
  const auto plane = plane_of(models, branch, point.value, {wanted.from, wanted.to, second}, options, wanted.points);
  const analysis::LocusCorrection start = locus_start(plane.first, special, second);
  if (!start.found) {
    result.message = start.message;
    return result;
  }
  const analysis::LocusSubject subject = analysis::subject_of(special);
  const auto follow = [&](const LocusPoint& from, std::string& end) {
    std::vector<LocusRow> rows;
    LocusTrace trace(plane.first, subject, plane.second, from);
    while (trace.advance()) {
      for (const analysis::Codim2Point& mark : trace.marks()) rows.push_back(row_of(mark.point, to_string(mark.kind)));
      rows.push_back(row_of(trace.current(), {}));
    }
    end = end_word(trace.end());
    if (trace.end() == LocusEnd::min_step) result.message = trace.state().message;
    return rows;
  };
  std::vector<LocusRow> forward = follow(start.point, result.last_end);
  if (result.last_end == "closed") {
    result.first_end = "closed";
  } else {
    result.rows = follow(analysis::reversed(start.point), result.first_end);
    std::ranges::reverse(result.rows);
  }
  LocusRow here = row_of(start.point, {});
  here.first_bound = point.error_bound;
  here.second_bound = 0.0;
  result.rows.push_back(std::move(here));
  std::ranges::move(forward, std::back_inserter(result.rows));
  return result;
}

std::optional<analysis::ExactValue> exact_value(const ModelOverPlane& models, const TracedBranches& traced,
                                                const SpecialRow& point, double width, const BranchesOptions& options,
                                                std::string& why_not) {
  using analysis::SpecialKind;
  why_not = "no value with the exact clearance: such a point has no locus over the width";
  if (point.kind == SpecialKind::unresolved ||
      (point.kind == SpecialKind::branch_point && point.broken_symmetry.empty()))
    return std::nullopt;
  const analysis::Branch& branch = traced.branches[point.branch];
  const analysis::SpecialPoint& special = branch.special[point.point];
  const analysis::LocusSubject subject = analysis::subject_of(special);
  std::vector<analysis::SmoothedValue> values = {{width, point.value}};
  double bound = point.error_bound;
  std::optional<LocusPoint> from;
  constexpr int most = 200;
  constexpr double slack = 1.001;  // the start is on its width to rounding
  for (int halving = 0; halving < 3; ++halving) {
    const double here = values.back().width;
    const auto [surface, o] =
        plane_of(models, branch, values.back().value, {0.5 * here, slack * here, here}, options, most);
    if (!from) {
      const analysis::LocusCorrection start = locus_start(surface, special, width);
      if (!start.found) {
        why_not = "no value with the exact clearance: " + start.message + "; a finer tolerance may help";
        return std::nullopt;
      }
      from = analysis::reversed(start.point);
    }
    LocusTrace trace(surface, subject, o, *from);
    while (trace.advance()) {
    }
    if (trace.end() != LocusEnd::range || trace.current().second() != 0.5 * here) {
      why_not = "no value with the exact clearance: the locus over the width ends at " +
                short_text(trace.current().second()) + ", " + end_word(trace.end()) + "; a finer tolerance may help";
      return std::nullopt;
    }
    from = trace.current();
    values.push_back({0.5 * here, from->first()});
    bound = std::max(bound, from->first_bound);
  }
  analysis::ExactValue exact = analysis::extrapolated_to_exact(values);
  // The extrapolation passes the values' own errors on, grown by less.
  constexpr double growth = 4.0;
  exact.bound += growth * bound;
  return exact;
}

}  // namespace epicyclic::studies
