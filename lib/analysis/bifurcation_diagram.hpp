// All branches that can be reached from some orbits: traced both ways, and on where they change.
//
// A branch is followed from its start to both of its ends. At flips the orbits of twice the period leave, at branch
// points those that cross: each is a branch of its own, until the period is that asked for. A branch of twice the
// period ends where its orbit has the shorter one again, at a flip of the branch that it was born on; one without the
// symmetry where the orbit has it again. What is met twice is followed once: such an end is looked for among the
// special points that are known, and a branch point on two branches is one. A step may also end beyond such a place, on
// the orbits of the shorter period or with the symmetry, which are solutions too: the branch ends before it.
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
  bool born = false;                    ///< at the flip or branch point that it was born at
  std::optional<SpecialPlace> place{};  ///< that point, if it is known
  std::string message{};
};

struct Branch {
  OrbitFamily family;
  std::vector<BranchOrbit> orbits;                   ///< from its first end to its last; directions go that way
  std::vector<SpecialPoint> special;                 ///< as they were found
  std::vector<std::size_t> after;                    ///< of each special point: the orbit before it
  std::vector<std::optional<SpecialPlace>> same_as;  ///< of each: the point of an earlier branch that it is
  BranchLimit first, last;
  double least = -std::numeric_limits<double>::infinity();    ///< value that it was followed to at most
  double greatest = std::numeric_limits<double>::infinity();  ///< and at the other end
};

struct TreeOptions {
  ContinuationOptions continuation;
  SpecialOptions special{};
  SwitchOptions switching{};
  int largest_period = 2;      ///< that flips are followed to
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
    skipped,   ///< a start on a branch that is known, or one more than asked for
    begun,     ///< the next branch
    followed,  ///< to the next orbit, or to the end of its way
  };
  Kind kind = Kind::followed;
  bool full = false;                   ///< more branches are there than asked for
  ContinuationState trace{};           ///< behind the step
  std::optional<BranchOrbit> orbit{};  ///< next on the way
  std::vector<SpecialPoint> special{};
  std::vector<std::optional<SpecialPlace>> same_as{};
  std::vector<BranchStart> branch_switches{};
  std::optional<BranchLimit> limit{};  ///< where the way has ended
};

/// A tree is what its steps make of it: one that is given the steps of another, apply() after apply(), goes on with the
/// same bits.
class BifurcationDiagram {
 public:
  /// @param system  flows, scales, symmetry and accuracy of all branches
  /// @throws InputError for options out of range
  BifurcationDiagram(OrbitFamily system, TreeOptions options);

  /// An orbit of the system's period and pieces to start from, unless a branch goes through it when its turn comes.
  /// @param keeps_symmetry  among the orbits that the symmetry leaves as they are
  void start(BranchOrbit orbit, bool keeps_symmetry);
  /// One of another period, its least, and other pieces; not followed further from its value than `reach`.
  void start(BranchOrbit orbit, bool keeps_symmetry, int period, int shooting_intervals,
             double reach = std::numeric_limits<double>::infinity());
  void start(BranchOrbit orbit) { start(std::move(orbit), system_.keeps_symmetry); }

  /// Follows the branch under way to its next orbit, or begins the next branch.
  /// @returns what was done; nothing if there was nothing to do
  std::optional<TreeStep> advance();

  /// Does what advance() has done, computing nothing.
  void apply(TreeStep step);

  /// Those that are traced to both ends.
  [[nodiscard]] const std::vector<Branch>& branches() const { return branches_; }
  /// The one under way as far as it is traced, with no end where it still goes on; nothing between two branches.
  [[nodiscard]] std::optional<Branch> unfinished_branch() const;
  [[nodiscard]] std::size_t waiting() const { return starts_.size(); }  ///< starts of branches to come
  [[nodiscard]] bool full() const { return full_; }                     ///< more branches were there than asked for

 private:
  /// One way along the branch under way.
  struct BranchPart {
    std::vector<BranchOrbit> orbits;  ///< from the start on
    std::vector<SpecialPoint> special;
    std::vector<std::size_t> after;  ///< of each: the orbit before it on this way
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
  /// Is the branch the one that leaves the flip that the start is from, seen from its other end?
  [[nodiscard]] bool ended_at_the_birth_of(const Branch& branch, const BranchStart& start) const;
  [[nodiscard]] bool passes(const Branch& branch, const BranchStart& start) const;

  OrbitFamily system_;
  TreeOptions options_;
  std::vector<Branch> branches_;
  std::deque<BranchStart> starts_;
  BranchStart current_;                ///< of the branch under way
  OrbitFamily family_;                 ///< of it
  std::optional<Continuation> trace_;  ///< of the way under way
  std::vector<BranchPart> parts_;      ///< forward, then backward
  std::vector<std::optional<SpecialPlace>> same_as_;
  bool full_ = false;
};

}  // namespace epicyclic::analysis
