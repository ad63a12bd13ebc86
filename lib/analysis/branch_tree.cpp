#include "analysis/branch_tree.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/require.hpp"

namespace epicyclic::analysis {

namespace {

BranchOrbit reversed(BranchOrbit orbit) {
  orbit.direction = -1.0 * orbit.direction;
  return orbit;
}

/// Does the orbit's second half repeat its first?
bool has_half_the_period(const Eigen::MatrixXd& states, double difference) {
  const Eigen::Index half = states.cols() / 2;
  return states.cols() % 2 == 0 && states.cols() > 0 &&
         (states.leftCols(half) - states.rightCols(half)).lpNorm<Eigen::Infinity>() <= difference;
}

bool is_left_as_it_is(const Eigen::MatrixXd& states, const CyclicSymmetry& symmetry, double difference) {
  return states.cols() > 0 && (symmetry.map * states - states).lpNorm<Eigen::Infinity>() <= difference;
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

BranchTree::BranchTree(TreeOptions options) : options_(std::move(options)) { options_.validate(); }

void BranchTree::start(OrbitFamily family, BranchOrbit orbit) {
  starts_.push_back({std::move(family), std::move(orbit)});
}

bool BranchTree::advance() {
  if (trace_) {
    step();
    return true;
  }
  if (starts_.empty()) return false;
  Start next = std::move(starts_.front());
  starts_.pop_front();
  for (const Branch& branch : branches_)
    if (passes(branch, next)) return true;
  if (branches_.size() >= options_.branches) {
    full_ = true;
    return true;
  }
  begin(std::move(next));
  return true;
}

void BranchTree::begin(Start start) {
  current_ = std::move(start);
  ways_ = {Way{{current_->orbit}, {}, {}, {}}};
  same_as_.clear();
  trace_.emplace(current_->family, options_.continuation, current_->orbit);
}

void BranchTree::step() {
  Way& way = ways_.back();
  if (!trace_->advance()) {
    way.limit = {trace_->end(), false, std::nullopt, trace_->message()};
  } else {
    const auto found = special_points_between(current_->family, trace_->before(), trace_->now(), options_.special);
    for (const SpecialPoint& point : found) {
      if (!loses_itself(point)) {
        see(point);
        continue;
      }
      // Behind it the same orbits come again, begun at another period or turned.
      const Eigen::MatrixXd states = period_states(current_->family, point.orbit.at);
      way.limit = {BranchEnd::none, true, known_place(states, point.value), {}};
      way.orbits.push_back(point.orbit);
      break;
    }
    if (!way.limit.born) {
      way.orbits.push_back(trace_->now());
      if (trace_->end() == BranchEnd::none) return;
      way.limit = {trace_->end(), false, std::nullopt, {}};
    }
  }
  trace_.reset();
  // A closed branch has been seen whole, one that left a special point begins there.
  if (ways_.size() == 1 && way.limit.end != BranchEnd::closed && !current_->from) {
    const BranchOrbit back = reversed(current_->orbit);
    ways_.push_back(Way{{back}, {}, {}, {}});
    trace_.emplace(current_->family, options_.continuation, back);
    return;
  }
  finish_branch();
}

void BranchTree::see(SpecialPoint point) {
  Way& way = ways_.back();
  way.after.push_back(way.orbits.size() - 1);
  std::optional<SpecialPlace> same;
  if (point.kind == SpecialKind::branch_point)
    same = known_place(period_states(current_->family, point.orbit.at), point.value);
  same_as_.push_back(same);
  if (!same) leave(point, same_as_.size() - 1);
  way.special.push_back(std::move(point));
}

void BranchTree::leave(const SpecialPoint& point, std::size_t at) {
  const bool flip = point.kind == SpecialKind::flip && 2 * current_->family.period <= options_.largest_period;
  const bool branch_point = point.kind == SpecialKind::branch_point && options_.branch_points;
  if (!flip && !branch_point) return;
  const ContinuationOptions& range = options_.continuation;
  for (Departure& d : departures(current_->family, point, options_.switching)) {
    if (d.orbit.at.value < range.from || d.orbit.at.value > range.to) continue;
    starts_.push_back(
        {std::move(d.family), std::move(d.orbit), SpecialPlace{branches_.size(), at}, std::move(d.origin)});
  }
}

void BranchTree::finish_branch() {
  Branch branch{current_->family, {}, {}, {}, std::move(same_as_), {}, {}};
  Way& forward = ways_.front();
  branch.last = forward.limit;
  branch.first = forward.limit.end == BranchEnd::closed ? forward.limit : BranchLimit{};
  std::size_t before = 0;
  if (ways_.size() == 2) {
    const Way& backward = ways_.back();
    branch.first = backward.limit;
    before = backward.orbits.size() - 1;
    for (std::size_t k = before; k > 0; --k) branch.orbits.push_back(reversed(backward.orbits[k]));
  } else if (current_->from) {
    branch.first = {BranchEnd::none, true, current_->from, {}};
    branch.orbits.push_back(*current_->origin);
    before = 1;
  }
  std::move(forward.orbits.begin(), forward.orbits.end(), std::back_inserter(branch.orbits));
  for (std::size_t k = 0; k < forward.special.size(); ++k) {
    branch.special.push_back(std::move(forward.special[k]));
    branch.after.push_back(forward.after[k] + before);
  }
  if (ways_.size() == 2) {
    Way& backward = ways_.back();
    for (std::size_t k = 0; k < backward.special.size(); ++k) {
      SpecialPoint& point = backward.special[k];
      point.outwards = !point.outwards;
      point.rising = !point.rising;
      point.orbit = reversed(std::move(point.orbit));
      branch.special.push_back(std::move(point));
      branch.after.push_back(before - backward.after[k] - 1);
    }
  }
  branches_.push_back(std::move(branch));
  current_.reset();
}

bool BranchTree::loses_itself(const SpecialPoint& point) const {
  if (point.kind != SpecialKind::branch_point || point.wave != 0) return false;
  const OrbitFamily& family = current_->family;
  const Eigen::MatrixXd states = period_states(family, point.orbit.at);
  const double difference = options_.same * family.state_scale;
  const bool symmetric = !family.keeps_symmetry && family.symmetry.map.size() != 0 &&
                         is_left_as_it_is(states, family.symmetry, difference);
  return symmetric || has_half_the_period(states, difference);
}

std::optional<SpecialPlace> BranchTree::known_place(const Eigen::MatrixXd& states, double value) const {
  const OrbitFamily& family = current_->family;
  const double difference = options_.same * family.state_scale;
  const auto is_it = [&](const OrbitFamily& other, const SpecialPoint& p) {
    if (p.kind != SpecialKind::flip && p.kind != SpecialKind::branch_point) return false;
    if (std::abs(p.value - value) > options_.same_value * family.value_scale) return false;
    const Eigen::MatrixXd at = period_states(other, p.orbit.at);
    // Of the period of the other branch, which may be half of ours.
    const Eigen::Index n = at.cols();
    return n > 0 && n <= states.cols() && are_images(at, states.leftCols(n), family.symmetry, difference);
  };
  for (std::size_t b = 0; b < branches_.size(); ++b)
    for (std::size_t k = 0; k < branches_[b].special.size(); ++k)
      if (is_it(branches_[b].family, branches_[b].special[k])) return SpecialPlace{b, k};
  return std::nullopt;
}

bool BranchTree::passes(const Branch& branch, const Start& start) const {
  if (branch.family.period != start.family.period) return false;
  const double value = start.orbit.at.value;
  const double difference = options_.same * start.family.state_scale;
  Eigen::MatrixXd states;
  for (std::size_t k = 0; k + 1 < branch.orbits.size(); ++k) {
    const BranchOrbit& a = branch.orbits[k];
    const BranchOrbit& b = branch.orbits[k + 1];
    if ((a.at.value - value) * (b.at.value - value) > 0.0 || a.at.value == b.at.value) continue;
    const double part = (value - a.at.value) / (b.at.value - a.at.value);
    const Correction c = correct_at(branch.family, value, (1.0 - part) * a.at.states + part * b.at.states);
    if (!c.found) continue;
    if (states.size() == 0) states = period_states(start.family, start.orbit.at);
    if (are_images(states, period_states(branch.family, c.orbit.at), branch.family.symmetry, difference)) return true;
  }
  return false;
}

}  // namespace epicyclic::analysis
