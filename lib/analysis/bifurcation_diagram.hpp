// All branches that can be reached from given orbits. Each branch is traced in both directions, and the branches that
// begin at its special points are traced too.
//
// A branch is followed from its start to both of its ends. Branches of twice the period begin at period
// doublings. Other branches cross at branch points. Each one is a branch of its own, up to the largest requested
// period. A branch of twice the period ends where its orbit has the shorter period again: at a period doubling of the
// branch that it began on. A branch without the symmetry ends where its orbit has the symmetry again. Each branch is
// followed once: such an end is compared with the known special points, and a branch point on two branches counts once.
// A step may also end beyond such a place, on the orbits of the shorter period or with the symmetry, which are
// solutions too: the branch ends before it.
//
// Limits: a branch that no special point of the others leads to is found from a start of its own only.
#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/branch_switching.hpp"
#include "analysis/continuation.hpp"
#include "analysis/special_points.hpp"

namespace epicyclic::analysis {

/// A special point of a branch.
struct SpecialPlace {
  std::size_t branch = 0;
  std::size_t point = 0;
};

/// How a branch ends.
struct BranchLimit {
  BranchEnd end = BranchEnd::none;
  bool born = false;                    ///< at the period doubling or branch point where the branch began
  std::optional<SpecialPlace> place{};  ///< that point, if it is known
  std::string message{};
};

struct Branch {
  OrbitFamily family;
  std::vector<BranchOrbit> orbits;    ///< from its first end to its last; directions point from first to last
  std::vector<SpecialPoint> special;  ///< as they were found
  std::vector<std::size_t> after;     ///< of each special point: the orbit before it
  std::vector<std::optional<SpecialPlace>> same_as;  ///< of each: the point of an earlier branch that it is
  BranchLimit first, last;
  double least = -std::numeric_limits<double>::infinity();    ///< value that it was followed to at most
  double greatest = std::numeric_limits<double>::infinity();  ///< and at the other end
};

struct TreeOptions {
  ContinuationOptions continuation;
  SpecialOptions special{};
  SwitchOptions switching{};
  int largest_period = 2;      ///< largest period after period doublings
  bool branch_points = true;   ///< are other branches at branch points followed?
  std::size_t branches = 100;  ///< most
  double same = 1e-3;          ///< most difference of states of one orbit found twice, in state scales
  double same_value = 1e-5;    ///< and of the parameter, in its scale

  /// @throws InputError for bounds out of range
  void validate() const;
};

/// An orbit that a branch is to be followed from, or was.
struct BranchStart {
  int period = 1;
  int shooting_intervals = 1;
  bool keeps_symmetry = true;
  BranchOrbit orbit;
  std::optional<SpecialPlace> from{};                         ///< that it leaves: the branch begins there
  std::optional<BranchOrbit> origin{};                        ///< that point
  double least = -std::numeric_limits<double>::infinity();    ///< value that it, and what leaves it, is followed to
  double greatest = std::numeric_limits<double>::infinity();  ///< the range is not left in any case
};

/// What one step of a tree has found.
struct TreeStep {
  enum class Kind {
    skipped,   ///< a start on a known branch, or one beyond the largest number of branches
    begun,     ///< the next branch
    followed,  ///< to the next orbit, or to the end of this part of the branch
  };
  Kind kind = Kind::followed;
  bool full = false;                   ///< there are more branches than the options allow
  ContinuationState trace{};           ///< behind the step
  std::optional<BranchOrbit> orbit{};  ///< next orbit of this part
  std::vector<SpecialPoint> special{};
  std::vector<std::optional<SpecialPlace>> same_as{};
  std::vector<BranchStart> branch_switches{};
  std::optional<BranchLimit> limit{};  ///< where this part of the branch ended
};

/// A tree is what its steps make of it: one that is given the steps of another, apply() after apply(), goes on with the
/// same bits.
class BifurcationDiagram {
 public:
  /// @param system  flows, scales, symmetry and accuracy of all branches
  /// @throws InputError for options out of range
  BifurcationDiagram(OrbitFamily system, TreeOptions options);

  /// A starting orbit with the period and the shooting intervals of the system. It is skipped if a branch already
  /// passes through it when the diagram comes to it.
  /// @param keeps_symmetry  the orbit is among those that the symmetry maps to themselves
  void start(BranchOrbit orbit, bool keeps_symmetry);
  /// A starting orbit with another least period and other shooting intervals. Its branch is followed within `reach` of
  /// its value.
  void start(BranchOrbit orbit, bool keeps_symmetry, int period, int shooting_intervals,
             double reach = std::numeric_limits<double>::infinity());
  void start(BranchOrbit orbit) { start(std::move(orbit), system_.keeps_symmetry); }

  /// Follows the current branch to its next orbit, or begins the next branch.
  /// @returns what was done; nothing if there was nothing to do
  std::optional<TreeStep> advance();

  /// Does what advance() has done, computing nothing.
  void apply(TreeStep step);

  /// Those that are traced to both ends.
  [[nodiscard]] const std::vector<Branch>& branches() const { return branches_; }
  /// The current branch as far as it is traced, without a limit at an open end; nothing between two branches.
  [[nodiscard]] std::optional<Branch> unfinished_branch() const;
  [[nodiscard]] std::size_t waiting() const { return starts_.size(); }  ///< starts of branches to come
  [[nodiscard]] bool full() const { return full_; }  ///< there were more branches than the options allow

 private:
  /// The part of the current branch that is traced in one direction.
  struct BranchPart {
    std::vector<BranchOrbit> orbits;  ///< from the start on
    std::vector<SpecialPoint> special;
    std::vector<std::size_t> after;  ///< of each: the orbit before it on this part
    BranchLimit limit;
  };

  [[nodiscard]] OrbitFamily family_of(const BranchStart& start) const;
  [[nodiscard]] TreeStep next_start() const;
  [[nodiscard]] TreeStep next_orbit();
  void see(SpecialPoint point, TreeStep& step) const;
  [[nodiscard]] std::vector<BranchStart> leaving(const SpecialPoint& point, std::size_t number) const;
  void begin_part(const BranchOrbit& from);
  [[nodiscard]] ContinuationOptions range_of(const BranchStart& start) const;
  void end_part(const BranchLimit& limit);
  [[nodiscard]] Branch joined(std::vector<BranchPart> parts) const;
  void finish_branch();
  [[nodiscard]] bool loses_itself(const SpecialPoint& point) const;
  [[nodiscard]] bool has_fallen_onto_another() const;
  [[nodiscard]] std::optional<SpecialPlace> place_behind(const BranchOrbit& last, double beyond) const;
  [[nodiscard]] std::optional<SpecialPlace> known_place(const SpecialPoint& point) const;
  /// Is the branch the one that begins at the period doubling of the start, traced from its other end?
  [[nodiscard]] bool ended_at_the_birth_of(const Branch& branch, const BranchStart& start) const;
  [[nodiscard]] bool passes(const Branch& branch, const BranchStart& start) const;

  OrbitFamily system_;
  TreeOptions options_;
  std::vector<Branch> branches_;
  std::deque<BranchStart> starts_;
  BranchStart current_;                ///< of the current branch
  OrbitFamily family_;                 ///< of it
  std::optional<Continuation> trace_;  ///< of the current part
  std::vector<BranchPart> parts_;      ///< forward, then backward
  std::vector<std::optional<SpecialPlace>> same_as_;
  bool full_ = false;
};

}  // namespace epicyclic::analysis
