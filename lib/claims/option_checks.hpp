// Errors in the options of a study of claims, found by several functions and reported together: conditions that can
// never hold or never fail, and parameters without effect.
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "claims/options.hpp"

namespace epicyclic::claims {

using Names = std::set<std::string, std::less<>>;

/// Collects errors.
class ProblemList {
 public:
  void refuse(const std::string& place, std::string message) { found_.emplace_back(place, std::move(message)); }

  /// Checks that a list has names, and each once.
  template <class List>
  Names names(const List& list, const std::string& place) {
    Names all;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const std::string at = place + "/" + std::to_string(k) + "/name";
      if (list[k].name.empty())
        refuse(at, "is empty, must be a name");
      else if (!all.insert(list[k].name).second)
        refuse(at, "is \"" + list[k].name + "\", as one before it; names must differ");
    }
    return all;
  }

  [[nodiscard]] std::size_t count() const { return found_.size(); }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> found() && { return std::move(found_); }

 private:
  std::vector<std::pair<std::string, std::string>> found_;
};

/// Whether the study has a sweep of that name.
void check_sweep_name(ProblemList& problems, const std::string& place, const std::string& name, const Names& sweeps);

/// Whether the study has a stage of that name.
void check_stage_name(ProblemList& problems, const std::string& place, const std::string& name, const Names& stages);

/// Checks of a condition alone: the keys that its kind reads, and their values.
/// @param place  of the condition below the study
void check_condition(ProblemList& problems, const std::string& place, const Condition& condition, const Names& sweeps,
                     const Names& stages);

/// Requirements of a condition on the grids of its sweeps, in each evaluation, and on the evaluations.
void check_grids(ProblemList& problems, const std::string& place, const Condition& condition,
                 const ClaimsOptions& options);

/// Can each free parameter and each choice have an effect?
void check_space(ProblemList& problems, const ParameterSpace& space);

}  // namespace epicyclic::claims
