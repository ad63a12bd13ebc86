#include "input/aliases.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "input/json_source.hpp"
#include "input/origins.hpp"
#include "input/pointers.hpp"

namespace epicyclic::input {

using nlohmann::json;

namespace {

using Kind = Alias::Kind;

constexpr std::array all_aliases = {
    // The stage.
    Alias{Kind::key, "/stage/catalogue/carrier/body", "cheeks", "plates"},
    Alias{Kind::key, "/stage/catalogue/carrier/body", "cheek_thickness_mm", "plate_thickness_mm"},
    // Branches.
    Alias{Kind::key, "/study", "largest_period", "period_max", "continue"},
    Alias{Kind::key, "/study", "largest_step", "max_step", "continue"},
    Alias{Kind::key, "/study", "pieces", "shooting_intervals", "continue"},
    Alias{Kind::key, "/study", "settle_periods", "transient_periods", "continue"},
    Alias{Kind::key, "/study/search", "largest_period", "period_max", "continue"},
    Alias{Kind::key, "/study/seeds/N", "reach", "max_distance", "continue"},
    // Basins.
    Alias{Kind::key, "/study", "base", "other_components", "basins"},
    // Claims.
    Alias{Kind::key, "/study", "brief", "screening", "claims"},
    Alias{Kind::key, "/study/sweeps/N", "brief_points", "screening_points", "claims"},
    Alias{Kind::key, "/study/sweeps/N", "round", "screening_round", "claims"},
    Alias{Kind::key, "/study/sweeps/N/at/N", "as", "same_as", "claims"},
    Alias{Kind::key, "/study/claims/N", "printed", "published", "claims"},
    Alias{Kind::key, "/study/claims/N/conditions/N", "motion", "regime", "claims"},
    Alias{Kind::key, "/study/claims/N/conditions/N", "motions", "regimes", "claims"},
    Alias{Kind::key, "/study/claims/N/conditions/N", "after", "regime_after", "claims"},
    Alias{Kind::key, "/study/claims/N/conditions/N", "places", "peak_locations", "claims"},
    Alias{Kind::key, "/study/claims/N/conditions/N", "place_tolerance", "location_tolerance", "claims"},
    Alias{Kind::key, "/study/parameters/N", "words", "description", "claims"},
    Alias{Kind::key, "/study/parameters/N", "spread", "scale", "claims"},
    Alias{Kind::key, "/study/search", "led_by", "regime_cost", "claims"},
    Alias{Kind::key, "/study/search", "exchange", "migration_interval", "claims"},
    Alias{Kind::key, "/study/survey", "look", "screening", "claims"},

    Alias{Kind::value, "/stage/boundary", "literal", "as_printed"},
    Alias{Kind::value, "/stage/lumped/*/stiffness_curve/interpolation", "straight", "linear"},
    Alias{Kind::value, "/stage/lumped/*/friction/interpolation", "straight", "linear"},
    Alias{Kind::value, "/stage/lumped/*/friction/lubricated/load_share_interpolation", "straight", "linear"},
    Alias{Kind::value, "/model/gyroscopic", "printed", "as_printed"},
    Alias{Kind::value, "/study/start", "carried", "continued"},
    Alias{Kind::value, "/study/starts/N", "carried", "continued", "claims"},
    Alias{Kind::value, "/study/claims/N/conditions/N/kind", "alike", "agreement", "claims"},
    Alias{Kind::value, "/study/claims/N/conditions/N/kind", "falls", "reduction", "claims"},
    Alias{Kind::value, "/study/claims/N/conditions/N/statistic", "least", "min", "claims"},
    Alias{Kind::value, "/study/claims/N/conditions/N/statistic", "largest", "max", "claims"},
    Alias{Kind::value, "/study/search/regime_cost", "motions", "regimes", "claims"},

    Alias{Kind::column, "points.csv", "pull_sp", "tensile_force_sp"},
    Alias{Kind::column, "points.csv", "pull_rp", "tensile_force_rp"},
    Alias{Kind::column, "points.csv", "pull_time_sp", "tensile_time_sp"},
    Alias{Kind::column, "points.csv", "pull_time_rp", "tensile_time_rp"},
    Alias{Kind::column, "points.csv", "settled", "converged"},
    Alias{Kind::column, "branch.csv", "pull_sp", "tensile_force_sp"},
    Alias{Kind::column, "branch.csv", "pull_rp", "tensile_force_rp"},
    Alias{Kind::column, "branch.csv", "pull_time_sp", "tensile_time_sp"},
    Alias{Kind::column, "branch.csv", "pull_time_rp", "tensile_time_rp"},
    Alias{Kind::column, "branches.csv", "in_step", "symmetric"},
    Alias{Kind::column, "orbits.csv", "in_step", "symmetric"},
    Alias{Kind::column, "loci.csv", "marked", "codimension_two"},
    Alias{Kind::column, "attractors.csv", "planets_on", "image_rotation"},
    Alias{Kind::column, "proof.csv", "motion_before", "regime_before"},
    Alias{Kind::column, "proof.csv", "motion_after", "regime_after"},
    Alias{Kind::column, "proof.csv", "words", "explanation"},
    Alias{Kind::column, "scorecard.csv", "carried", "continued"},
    Alias{Kind::column, "scorecard.csv", "measured_carried", "measured_continued"},
    Alias{Kind::column, "candidates.csv", "given_up", "stopped_early"},
    Alias{Kind::column, "robustness.csv", "confirmed_look_only", "confirmed_screening_only"},
};

/// Is a pointer of this place?
bool is_at(std::string_view place, std::string_view pointer) {
  while (!place.empty() && !pointer.empty()) {
    const std::string_view step = place.substr(1, place.find('/', 1) - 1);
    const std::string_view there = pointer.substr(1, pointer.find('/', 1) - 1);
    const bool index = !there.empty() && there.find_first_not_of("0123456789") == std::string_view::npos;
    if (step != "*" && step != there && !(step == "N" && (index || there == "N"))) return false;
    place.remove_prefix(1 + step.size());
    pointer.remove_prefix(1 + there.size());
  }
  return place.empty() && pointer.empty();
}

/// @param place  by new names
const Alias* find_alias(Alias::Kind kind, std::string_view place, std::string_view name, std::string_view study) {
  const auto found = std::ranges::find_if(all_aliases, [&](const Alias& alias) {
    return alias.kind == kind && alias.old_name == name && is_at(alias.place, place) &&
           (alias.study.empty() || study.empty() || alias.study == study);
  });
  return found == all_aliases.end() ? nullptr : &*found;
}

/// Below which patches and assignments change the stage.
std::string place_of(const std::string& pointer) {
  return pointer_within(pointer, patch_root) ? std::string(stage_root) + pointer.substr(patch_root.size()) : pointer;
}

std::string renamed_pointer(const std::string& pointer, std::string_view study, Renaming* renaming) {
  if (!pointer.starts_with('/')) return pointer;
  bool any = false;
  std::string renamed;
  for (const std::string& step : pointer_steps(pointer)) {
    const Alias* alias = find_alias(Kind::key, place_of(renamed), step, study);
    if (alias != nullptr && renaming != nullptr) renaming->warn(alias->warning());
    any = any || alias != nullptr;
    renamed += pointer_step(alias == nullptr ? step : std::string(alias->new_name));
  }
  return any ? renamed : pointer;  // as it is written if there is nothing to rename: it may be no pointer
}

class Renamer {
 public:
  Renamer(std::string_view study, Renaming* renaming) : study_(study), renaming_(renaming) {}

  void rename(json& value, const std::string& place, const std::string& at) const {
    if (value.is_string()) {
      rename_text(value, place);
    } else if (value.is_array()) {
      for (std::size_t k = 0; k < value.size(); ++k)
        if (value[k].is_structured() || value[k].is_string())
          rename(value[k], place + "/" + std::to_string(k), at + "/" + std::to_string(k));
    } else if (value.is_object()) {
      rename_keys(value, place, at);
      rename_members(value, place, at);
    }
  }

 private:
  void rename_text(json& value, const std::string& place) const {
    const auto& text = value.get_ref<const std::string&>();
    if (const Alias* alias = find_alias(Kind::value, place, text, study_)) {
      if (renaming_ != nullptr) renaming_->warn(alias->warning());
      value = alias->new_name;
    } else if (pointer_within(place, "/study")) {
      value = renamed_pointer(text, study_, renaming_);
    }
  }

  void rename_members(json& object, const std::string& place, const std::string& at) const {
    // The value that is set belongs to the pointer that it names.
    const auto is_set = [&](std::string_view list) { return is_at(list, place); };
    const bool sets = std::ranges::any_of(std::array{"/study/choices/N/options/N/sets/N", "/study/sweeps/N/sets/N",
                                                     "/study/stages/N/sets/N"},
                                          is_set) &&
                      object.contains("pointer") && object["pointer"].is_string();
    const std::string target = sets ? object["pointer"].get<std::string>() : std::string();
    for (auto& [name, member] : object.items()) {
      if (is_bookkeeping(name)) continue;
      std::string below = place + pointer_step(name);
      if (below == patch_root) below = stage_root;
      if (sets && name == "value") below = place_of(renamed_pointer(target, study_, nullptr));
      rename(member, below, at + pointer_step(name));
    }
  }

  void rename_keys(json& object, const std::string& place, const std::string& at) const {
    std::vector<const Alias*> found;
    for (const auto& [name, unused] : object.items())
      if (const Alias* alias = find_alias(Kind::key, place, name, study_)) found.push_back(alias);
    for (const Alias* alias : found) {
      const std::string from(alias->old_name);
      const std::string to(alias->new_name);
      if (renaming_ != nullptr) {
        renaming_->warn(alias->warning());
        renaming_->moved.emplace_back(at + pointer_step(from), at + pointer_step(to));
      }
      if (object.contains(to)) {
        if (renaming_ != nullptr)
          renaming_->clashes.emplace_back(at + pointer_step(to),
                                          "is given as '" + from + "' too, its old name; give '" + to + "' alone");
        object.erase(from);
        continue;
      }
      json member = std::move(object[from]);
      object.erase(from);
      object[to] = std::move(member);
      const auto origin = object.find("origin");
      if (origin == object.end() || !origin->is_object() || !origin->contains(from)) continue;
      json words = std::move((*origin)[from]);
      origin->erase(from);
      (*origin)[to] = std::move(words);
    }
  }

  std::string_view study_;
  Renaming* renaming_;
};

/// Pointer of a resolved input, or of its computed values, in the whole: for a stage alone it is below "/stage".
std::string root_of(const json& resolved) {
  const bool bare = (resolved.contains("lumped") || resolved.contains("catalogue")) && !resolved.contains("stage");
  return bare ? std::string(stage_root) : std::string();
}

}  // namespace

std::string Alias::warning() const {
  const auto quoted = [](std::string_view name) { return "'" + std::string(name) + "'"; };
  const std::string end = "; the old name works until " + std::string(aliases_end);
  const std::string in = std::string(place);
  switch (kind) {
    case Kind::key:
      return quoted(in + "/" + std::string(old_name)) + " is now " + quoted(in + "/" + std::string(new_name)) + end;
    case Kind::value:
      return "the value " + quoted(old_name) + " of '" + in + "' is now " + quoted(new_name) + end;
    case Kind::column:
      return "the column " + quoted(old_name) + " is now " + quoted(new_name) + end;
  }
  return {};
}

std::span<const Alias> aliases() { return all_aliases; }

void Renaming::warn(std::string text) {
  if (std::ranges::find(warnings, text) == warnings.end()) warnings.push_back(std::move(text));
}

void use_new_names(json& value, const std::string& place, std::string_view study, Renaming& renaming,
                   const std::string& at) {
  Renamer(study, &renaming).rename(value, place_of(place), at);
}

void use_new_names(json& resolved) { Renamer(study_of(resolved), nullptr).rename(resolved, root_of(resolved), ""); }

std::string study_of(const json& input) {
  const json* kind = find_at(input, "/study/kind");
  return kind != nullptr && kind->is_string() ? kind->get<std::string>() : std::string();
}

std::string new_pointer(const std::string& pointer, std::string_view study, Renaming& renaming) {
  return renamed_pointer(pointer, study, &renaming);
}

std::string new_value(std::string_view place, const std::string& name) {
  const Alias* alias = find_alias(Kind::value, place, name, "");
  return alias == nullptr ? name : std::string(alias->new_name);
}

std::string new_column(std::string_view table, const std::string& name) {
  const auto found = std::ranges::find_if(all_aliases, [&](const Alias& alias) {
    return alias.kind == Kind::column && alias.place == table && alias.old_name == name;
  });
  return found == all_aliases.end() ? name : std::string(found->new_name);
}

const Alias* find_column_alias(std::string_view old_name) {
  const auto found = std::ranges::find_if(
      all_aliases, [&](const Alias& alias) { return alias.kind == Kind::column && alias.old_name == old_name; });
  return found == all_aliases.end() ? nullptr : &*found;
}

}  // namespace epicyclic::input
