// The texts of an input, and the errors in them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/pointers.hpp"
#include "input/study_input.hpp"

namespace epicyclic::input {

/// The texts of an input, and for each pointer the text that contains it.
struct LoadedInput::Sources {
  std::filesystem::path path;
  std::shared_ptr<JsonFiles> files;  ///< shared by all inputs that are made of one
  JsonSource study;
  std::optional<JsonSource> stage;
  bool bare = false;     ///< the file is a stage alone
  nlohmann::json patch;  ///< as written
  std::vector<Assignment> sets;

  /// File and line of a pointer; of its nearest parent, if it is not there. The pointer is kept.
  [[nodiscard]] Problem locate(const std::string& pointer, std::string message) const {
    for (auto set = sets.rbegin(); set != sets.rend(); ++set) {
      const bool made_by_set = pointer_within(set->pointer, pointer) && !stands(pointer);
      if (pointer_within(pointer, set->pointer) || made_by_set) return {set->shown(), 0, pointer, std::move(message)};
    }
    if (!bare && pointer_within(pointer, stage_root)) {
      const std::string rest = pointer.substr(stage_root.size());
      if (patches(rest)) {
        const int line = study.line_of(std::string(patch_root) + rest);
        return {study.name, line, pointer, std::move(message) + " (from stage_patch)"};
      }
      if (stage) return {stage->name, stage->line_of(rest), pointer, std::move(message)};
    }
    return {study.name, study.line_of(pointer), pointer, std::move(message)};
  }

  /// Was the value at this pointer replaced because it could not be read (and that reported)?
  [[nodiscard]] bool is_unreadable(const std::string& pointer) const {
    for (const auto& set : sets)
      if (pointer_within(pointer, set.pointer)) return false;
    if (!bare && pointer_within(pointer, stage_root)) {
      const std::string rest = pointer.substr(stage_root.size());
      if (patches(rest)) return study.unreadable.count(std::string(patch_root) + rest) > 0;
      if (stage) return stage->unreadable.count(rest) > 0;
    }
    return study.unreadable.count(pointer) > 0;
  }

  /// The message of a finding; of an unknown key that an assignment made, with the pointer that was probably meant.
  [[nodiscard]] std::string meant_by_set(const Finding& finding) const {
    if (finding.kind == Finding::Kind::unknown_key && !stands(finding.pointer))
      for (auto set = sets.rbegin(); set != sets.rend(); ++set) {
        if (!pointer_within(set->pointer, finding.pointer)) continue;
        const std::vector<std::string> pointers = meant_pointers(set->pointer, all_places());
        const std::string meant = suggested(pointers);
        const std::size_t end = finding.message.find("'; ");
        const bool same = pointers.size() == 1 && pointers.front() == set->pointer;  // known elsewhere, not here
        if (!meant.empty() && !same && end != std::string::npos) return finding.message.substr(0, end + 1) + meant;
      }
    return finding.message;
  }

 private:
  [[nodiscard]] bool stands(const std::string& pointer) const {
    if (study.line.count(pointer) > 0) return true;
    if (bare || !pointer_within(pointer, stage_root)) return false;
    const std::string rest = pointer.substr(stage_root.size());
    return patches(rest) || (stage && stage->line.count(rest) > 0);
  }

  /// Does the patch write the value at this pointer of the stage?
  [[nodiscard]] bool patches(std::string_view rest) const {
    const nlohmann::json* at = &patch;
    for (const auto& step : pointer_steps(rest)) {
      if (!at->is_object()) break;
      const auto it = at->find(step);
      if (it == at->end()) return false;
      at = &*it;
    }
    if (!at->is_object()) return !at->is_null();
    return !rest.empty() && stage && stage->line.count(rest) == 0;  // an object that only the patch has
  }
};

/// Collects problems in the order of the texts: study, stage, assignments.
class Problems {
 public:
  void add(Problem problem) { all_.push_back(std::move(problem)); }
  void add(const JsonSource& source, std::string_view prefix = {}) {
    for (auto problem : source.problems) {
      if (!problem.pointer.empty() || problem.line > 0) problem.pointer.insert(0, prefix);
      all_.push_back(std::move(problem));
    }
  }
  [[nodiscard]] bool empty() const { return all_.empty(); }

  [[noreturn]] void raise(const std::string& study, const std::optional<JsonSource>& stage) {
    const auto rank = [&](const Problem& p) { return p.file == study ? 0 : stage && p.file == stage->name ? 1 : 2; };
    std::stable_sort(all_.begin(), all_.end(), [&](const Problem& a, const Problem& b) {
      return std::pair(rank(a), a.line) < std::pair(rank(b), b.line);
    });
    constexpr std::size_t most = 200;
    std::vector<Problem> once;
    std::set<std::string> reported;
    for (auto& problem : all_) {
      if (!reported.insert(problem.text()).second || reported.size() > most) continue;
      once.push_back(std::move(problem));
    }
    if (reported.size() > most) {
      Problem more = once.back();
      more.message = "and " + std::to_string(reported.size() - most) + " more problems";
      once.push_back(std::move(more));
    }
    throw InputProblems(std::move(once));
  }

 private:
  std::vector<Problem> all_;
};

}  // namespace epicyclic::input
