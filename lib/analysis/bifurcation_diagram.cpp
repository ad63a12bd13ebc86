#include "analysis/bifurcation_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/dense.hpp"
#include "core/require.hpp"

namespace epicyclic::analysis {

namespace {

BranchOrbit reversed(BranchOrbit orbit) {
  orbit.direction = -1.0 * orbit.direction;
  return orbit;
}

bool is_left_as_it_is(const Eigen::MatrixXd& states, const CyclicSymmetry& symmetry, double difference) {
  return states.cols() > 0 && (product(symmetry.map, states) - states).lpNorm<Eigen::Infinity>() <= difference;
}

}  // namespace

void TreeOptions::validate() const {
  continuation.validate();
  special.validate();
  switching.validate();
  require(largest_period >= 1, "largest_period", largest_period, ">= 1");
  require(branches >= 1, "branches", static_cast<double>(branches), ">= 1");
  require(same > 0.0, "same", same, "> 0");
  require(same_value > 0.0, "same_value", same_value, "> 0");
}

BifurcationDiagram::BifurcationDiagram(OrbitFamily system, TreeOptions options)
    : system_(std::move(system)), options_(std::move(options)) {
  system_.validate();
  options_.validate();
}

OrbitFamily BifurcationDiagram::family_of(const BranchStart& start) const {
  OrbitFamily family = system_;
  family.period = start.period;
  family.shooting_intervals = start.shooting_intervals;
  family.keeps_symmetry = start.keeps_symmetry;
  return family;
}

void BifurcationDiagram::start(BranchOrbit orbit, bool keeps_symmetry) {
  start(std::move(orbit), keeps_symmetry, system_.period, system_.shooting_intervals);
}

void BifurcationDiagram::start(BranchOrbit orbit, bool keeps_symmetry, int period, int shooting_intervals,
                               double reach) {
  BranchStart start{period, shooting_intervals, keeps_symmetry, std::move(orbit)};
  start.least = start.orbit.at.value - reach;
  start.greatest = start.orbit.at.value + reach;
  starts_.push_back(std::move(start));
}

std::optional<TreeStep> BifurcationDiagram::advance() {
  if (!trace_ && starts_.empty()) return std::nullopt;
  TreeStep step = trace_ ? next_orbit() : next_start();
  apply(step);
  return step;
}

TreeStep BifurcationDiagram::next_start() const {
  TreeStep step;
  step.kind = TreeStep::Kind::begun;
  for (const Branch& branch : branches_)
    if (ended_at_the_birth_of(branch, starts_.front()) || passes(branch, starts_.front()))
      step.kind = TreeStep::Kind::skipped;
  if (step.kind == TreeStep::Kind::begun && branches_.size() >= options_.branches) {
    step.kind = TreeStep::Kind::skipped;
    step.full = true;
  }
  return step;
}

TreeStep BifurcationDiagram::next_orbit() {
  TreeStep step;
  const bool moved = trace_->advance();
  if (moved && has_fallen_onto_another()) {
    step.limit = {BranchEnd::none, true, place_behind(trace_->previous(), trace_->current().at.value), {}};
  } else if (moved) {
    for (SpecialPoint& point :
         special_points_between(family_, trace_->previous(), trace_->current(), options_.special)) {
      if (!loses_itself(point)) {
        see(std::move(point), step);
        continue;
      }
      // Behind it the same orbits come again, begun at another period or rotated by the symmetry.
      step.limit = {BranchEnd::none, true, known_place(point), {}};
      step.orbit = std::move(point.orbit);
      break;
    }
    if (!step.orbit) step.orbit = trace_->current();
  }
  step.trace = trace_->state();
  if (!step.limit && trace_->end() != BranchEnd::none)
    step.limit = {trace_->end(), false, std::nullopt, trace_->end() == BranchEnd::min_step ? step.trace.message : ""};
  return step;
}

void BifurcationDiagram::see(SpecialPoint point, TreeStep& step) const {
  std::optional<SpecialPlace> same;
  if (point.kind == SpecialKind::branch_point) same = known_place(point);
  if (!same) {
    std::vector<BranchStart> more = leaving(point, same_as_.size() + step.same_as.size());
    std::move(more.begin(), more.end(), std::back_inserter(step.branch_switches));
  }
  step.same_as.push_back(same);
  step.special.push_back(std::move(point));
}

std::vector<BranchStart> BifurcationDiagram::leaving(const SpecialPoint& point, std::size_t number) const {
  std::vector<BranchStart> starts;
  const bool period_doubling =
      point.kind == SpecialKind::period_doubling && 2 * family_.period <= options_.largest_period;
  const bool branch_point = point.kind == SpecialKind::branch_point && options_.branch_points;
  if (!period_doubling && !branch_point) return starts;
  const ContinuationOptions range = range_of(current_);
  for (BranchSwitch& d : branch_switches(family_, point, options_.switching)) {
    if (d.orbit.at.value < range.from || d.orbit.at.value > range.to) continue;
    starts.push_back({d.family.period, d.family.shooting_intervals, d.family.keeps_symmetry, std::move(d.orbit),
                      SpecialPlace{branches_.size(), number}, std::move(d.origin), current_.least, current_.greatest});
  }
  return starts;
}

void BifurcationDiagram::apply(TreeStep step) {
  full_ = full_ || step.full;
  if (step.kind != TreeStep::Kind::followed) {
    BranchStart next = std::move(starts_.front());
    starts_.pop_front();
    if (step.kind == TreeStep::Kind::skipped) return;
    current_ = std::move(next);
    family_ = family_of(current_);
    parts_.clear();
    same_as_.clear();
    begin_part(current_.orbit);
    return;
  }
  BranchPart& part = parts_.back();
  part.after.insert(part.after.end(), step.special.size(), part.orbits.size() - 1);
  std::move(step.special.begin(), step.special.end(), std::back_inserter(part.special));
  std::move(step.same_as.begin(), step.same_as.end(), std::back_inserter(same_as_));
  // Before starts of others, which may be on what leaves here.
  const auto others = std::find_if(starts_.begin(), starts_.end(), [](const BranchStart& s) { return !s.from; });
  // With an empty range, libstdc++'s deque moves the elements before the place onto themselves, which empties their
  // vectors.
  if (!step.branch_switches.empty())
    starts_.insert(others, std::make_move_iterator(step.branch_switches.begin()),
                   std::make_move_iterator(step.branch_switches.end()));
  if (step.orbit) part.orbits.push_back(*std::move(step.orbit));
  trace_->restore(std::move(step.trace));
  if (step.limit) end_part(*step.limit);
}

void BifurcationDiagram::begin_part(const BranchOrbit& from) {
  parts_.push_back(BranchPart{{from}, {}, {}, {}});
  trace_.emplace(family_, range_of(current_), from);
}

ContinuationOptions BifurcationDiagram::range_of(const BranchStart& start) const {
  ContinuationOptions range = options_.continuation;
  range.from = std::max(range.from, start.least);
  range.to = std::min(range.to, start.greatest);
  return range;
}

void BifurcationDiagram::end_part(const BranchLimit& limit) {
  parts_.back().limit = limit;
  trace_.reset();
  // A closed branch has been seen whole, one that left a special point begins there.
  if (parts_.size() == 1 && limit.end != BranchEnd::closed && !current_.from) {
    begin_part(reversed(current_.orbit));
  } else {
    finish_branch();
  }
}

Branch BifurcationDiagram::joined(std::vector<BranchPart> parts) const {
  Branch branch{family_, {}, {}, {}, same_as_, {}, {}};
  BranchPart& forward = parts.front();
  branch.last = forward.limit;
  branch.first = forward.limit.end == BranchEnd::closed ? forward.limit : BranchLimit{};
  std::size_t before = 0;
  if (parts.size() == 2) {
    const BranchPart& backward = parts.back();
    branch.first = backward.limit;
    before = backward.orbits.size() - 1;
    for (std::size_t k = before; k > 0; --k) branch.orbits.push_back(reversed(backward.orbits[k]));
  } else if (current_.from) {
    branch.first = {BranchEnd::none, true, current_.from, {}};
    branch.orbits.push_back(*current_.origin);
    before = 1;
  }
  std::move(forward.orbits.begin(), forward.orbits.end(), std::back_inserter(branch.orbits));
  for (std::size_t k = 0; k < forward.special.size(); ++k) {
    branch.special.push_back(std::move(forward.special[k]));
    branch.after.push_back(forward.after[k] + before);
  }
  if (parts.size() == 2) {
    BranchPart& backward = parts.back();
    for (std::size_t k = 0; k < backward.special.size(); ++k) {
      SpecialPoint& point = backward.special[k];
      point.outwards = !point.outwards;
      point.rising = !point.rising;
      point.orbit = reversed(std::move(point.orbit));
      branch.special.push_back(std::move(point));
      branch.after.push_back(before - backward.after[k] - 1);
    }
  }
  branch.least = current_.least;
  branch.greatest = current_.greatest;
  return branch;
}

void BifurcationDiagram::finish_branch() { branches_.push_back(joined(std::move(parts_))); }

std::optional<Branch> BifurcationDiagram::unfinished_branch() const {
  if (!trace_) return std::nullopt;
  return joined(parts_);
}

bool BifurcationDiagram::loses_itself(const SpecialPoint& point) const {
  if (point.kind != SpecialKind::branch_point || point.symmetry_index != 0) return false;
  const Eigen::MatrixXd states = period_states(family_, point.orbit.at);
  const double difference = options_.same * family_.state_scale;
  const bool symmetric = !family_.keeps_symmetry && family_.symmetry.map.size() != 0 &&
                         is_left_as_it_is(states, family_.symmetry, difference);
  return symmetric || (states.cols() > 0 && least_period(states, difference) < family_.period);
}

bool BifurcationDiagram::has_fallen_onto_another() const {
  const double before = distance_to_simpler(family_, trace_->previous().at);
  // Around its birth a branch's own orbits come as near by chance alone.
  constexpr double near = 1e-2;
  constexpr double is_one = 1e-6;
  return before > is_one * family_.state_scale && distance_to_simpler(family_, trace_->current().at) < near * before;
}

std::optional<SpecialPlace> BifurcationDiagram::place_behind(const BranchOrbit& last, double beyond) const {
  const Eigen::MatrixXd states = period_states(family_, last.at);
  const double away = std::abs(beyond - last.at.value);
  std::optional<SpecialPlace> nearest;
  // Orbits of a branch that begins there are no further from it than from each other.
  double least = 2.0 * distance_to_simpler(family_, last.at);
  for (std::size_t b = 0; b < branches_.size(); ++b)
    for (std::size_t k = 0; k < branches_[b].special.size(); ++k) {
      const SpecialPoint& p = branches_[b].special[k];
      if (p.kind != SpecialKind::period_doubling && p.kind != SpecialKind::branch_point) continue;
      if (std::abs(p.value - last.at.value) > 2.0 * away) continue;
      const Eigen::MatrixXd at = period_states(branches_[b].family, p.orbit.at);
      if (at.cols() == 0 || at.cols() > states.cols()) continue;
      const double distance = image_distance(at, states.leftCols(at.cols()), family_.symmetry);
      if (distance >= least) continue;
      least = distance;
      nearest = SpecialPlace{b, k};
    }
  return nearest;
}

std::optional<SpecialPlace> BifurcationDiagram::known_place(const SpecialPoint& point) const {
  const Eigen::MatrixXd states = period_states(family_, point.orbit.at);
  const double difference = options_.same * family_.state_scale;
  const auto is_it = [&](const OrbitFamily& other, const SpecialPoint& p) {
    if (p.kind != SpecialKind::period_doubling && p.kind != SpecialKind::branch_point) return false;
    if (std::abs(p.value - point.value) > options_.same_value * family_.value_scale) return false;
    const Eigen::MatrixXd at = period_states(other, p.orbit.at);
    // The states of one period of the other branch, which may be half of this one.
    const Eigen::Index n = at.cols();
    return n > 0 && n <= states.cols() && are_images(at, states.leftCols(n), family_.symmetry, difference);
  };
  for (std::size_t b = 0; b < branches_.size(); ++b)
    for (std::size_t k = 0; k < branches_[b].special.size(); ++k)
      if (is_it(branches_[b].family, branches_[b].special[k])) return SpecialPlace{b, k};
  return std::nullopt;
}

bool BifurcationDiagram::ended_at_the_birth_of(const Branch& branch, const BranchStart& start) const {
  if (!start.from || branch.family.period != start.period) return false;
  const SpecialPoint& birth = branches_[start.from->branch].special[start.from->point];
  // At a period doubling that keeps the symmetry exactly one branch begins.
  if (birth.kind != SpecialKind::period_doubling || birth.symmetry_index != 0) return false;
  const auto ends_there = [&](const BranchLimit& limit) {
    return limit.born && limit.place && limit.place->branch == start.from->branch &&
           limit.place->point == start.from->point;
  };
  return ends_there(branch.first) || ends_there(branch.last);
}

bool BifurcationDiagram::passes(const Branch& branch, const BranchStart& start) const {
  if (branch.family.period != start.period) return false;
  // It goes as far as the start would be followed, too.
  const ContinuationOptions wanted = range_of(start);
  if (branch.least > wanted.from || branch.greatest < wanted.to) return false;
  const double value = start.orbit.at.value;
  const double difference = options_.same * system_.state_scale;
  Eigen::MatrixXd states;
  for (std::size_t k = 0; k + 1 < branch.orbits.size(); ++k) {
    const BranchOrbit& a = branch.orbits[k];
    const BranchOrbit& b = branch.orbits[k + 1];
    if ((a.at.value - value) * (b.at.value - value) > 0.0 || a.at.value == b.at.value) continue;
    const double part = (value - a.at.value) / (b.at.value - a.at.value);
    const Correction c = correct_at(branch.family, value, (1.0 - part) * a.at.states + part * b.at.states);
    if (!c.found) continue;
    if (states.size() == 0) states = period_states(family_of(start), start.orbit.at);
    if (are_images(states, period_states(branch.family, c.orbit.at), branch.family.symmetry, difference)) return true;
  }
  return false;
}

}  // namespace epicyclic::analysis
