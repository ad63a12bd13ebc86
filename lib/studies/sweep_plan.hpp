// The points of a sweep or a plane and the chains of their computation. Both follow from a rule, so that a plan of any
// size takes no memory.
//
// Points are numbered along the first axis, then the second, for the first direction, then the other. A line is the
// points of one direction and one value of the second axis; it is cut into chains of consecutive points.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "studies/axis.hpp"
#include "studies/plane_options.hpp"
#include "studies/sweep_options.hpp"

namespace epicyclic::studies {

/// One point of the grid.
struct GridPoint {
  std::size_t index = 0;
  Direction direction = Direction::up;
  double value = 0;
  double second_value = 0;  ///< along the second axis of a plane [studies/plane.hpp]

  bool operator==(const GridPoint&) const = default;
};

/// A sequence with a size and an element for each index, which it does not store.
template <class Derived>
class Indexed {
 public:
  class iterator {
   public:
    iterator(const Derived& of, std::size_t at) : of_(&of), at_(at) {}
    [[nodiscard]] auto operator*() const { return (*of_)[at_]; }
    iterator& operator++() {
      ++at_;
      return *this;
    }
    [[nodiscard]] bool operator==(const iterator& other) const { return at_ == other.at_; }

   private:
    const Derived* of_;
    std::size_t at_;
  };

  [[nodiscard]] bool empty() const { return self().size() == 0; }
  [[nodiscard]] auto front() const { return self()[0]; }
  [[nodiscard]] auto back() const { return self()[self().size() - 1]; }
  [[nodiscard]] iterator begin() const { return {self(), 0}; }
  [[nodiscard]] iterator end() const { return {self(), self().size()}; }

 private:
  [[nodiscard]] const Derived& self() const { return static_cast<const Derived&>(*this); }
};

/// The grid that a plan is made of.
struct PlanGrid {
  Axis first;
  Axis second = {{}, 0, 0, 1};
  std::vector<Direction> directions;
  std::size_t chains_per_line = 1;  ///< at most as many as the first axis has points
  int coarse_periods = 0;           ///< of the pass that gives the starts of chains [coarse_pass.hpp]; 0: by default

  [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(first.points); }
  [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(second.points); }
  [[nodiscard]] std::size_t lines() const { return directions.size() * rows(); }
};

class PlanPoints : public Indexed<PlanPoints> {
 public:
  explicit PlanPoints(PlanGrid grid) : grid_(std::move(grid)) {}
  [[nodiscard]] std::size_t size() const { return grid_.lines() * grid_.columns(); }
  [[nodiscard]] GridPoint operator[](std::size_t index) const;

 private:
  PlanGrid grid_;
};

/// Indices of consecutive points, in the order in which they are computed.
class Chain : public Indexed<Chain> {
 public:
  Chain(std::size_t first, std::size_t size) : first_(first), size_(size) {}
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t operator[](std::size_t place) const { return first_ + place; }

 private:
  std::size_t first_;
  std::size_t size_;
};

/// The first chain of each line, then the second of each, so that all lines advance side by side.
class PlanChains : public Indexed<PlanChains> {
 public:
  explicit PlanChains(PlanGrid grid) : grid_(std::move(grid)) {}
  [[nodiscard]] std::size_t size() const { return grid_.lines() * grid_.chains_per_line; }
  [[nodiscard]] Chain operator[](std::size_t chain) const;

 private:
  PlanGrid grid_;
};

struct SweepPlan {
  PlanGrid grid;
  PlanPoints points;
  PlanChains chains;

  explicit SweepPlan(const PlanGrid& of) : grid(of), points(of), chains(of) {}
};

/// @throws InputError from validate()
[[nodiscard]] SweepPlan plan_sweep(const SweepOptions& options);

/// A map with continued initial states runs along the first axis as a sweep does. Each row, one value of the second
/// parameter, is a chain of its own from the default start, so that the input fixes the chains.
/// @throws InputError from validate()
[[nodiscard]] SweepPlan plan_map(const MapOptions& options);

/// Each cell is a chain of its own.
/// @throws InputError from validate()
[[nodiscard]] SweepPlan plan_basins(const BasinsOptions& options);

}  // namespace epicyclic::studies
