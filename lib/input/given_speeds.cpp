#include "input/given_speeds.hpp"

#include <tuple>
#include <utility>

#include "input/added_kind.hpp"
#include "input/pointers.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::input {

namespace {

using nlohmann::json;
using Refuse = std::function<void(Finding::Kind, const std::string&, std::string)>;

/// The name, the ends and the place of each axis that a study has.
template <class F>
void for_each_axis(Study& study, F each) {
  if (auto* map = std::get_if<studies::MapOptions>(&study.plan)) {
    each(map->plane.first.name, map->plane.first.from, map->plane.first.to, "/study/first");
    each(map->plane.second.name, map->plane.second.from, map->plane.second.to, "/study/second");
  } else if (auto* branches = std::get_if<studies::BranchesOptions>(&study.plan)) {
    each(branches->parameter, branches->from, branches->to, "/study");
    if (auto& loci = branches->loci) each(loci->parameter, loci->from, loci->to, "/study/loci");
  } else if (study.has_points() && !std::holds_alternative<RunPlan>(study.plan) &&
             !std::holds_alternative<studies::BasinsOptions>(study.plan)) {
    studies::Axis& axis = sweep_in(study.plan).axis;
    each(axis.name, axis.from, axis.to, "/study");
  }
}

class Conversion {
 public:
  Conversion(Study& study, const json& whole, bool moves, const IsBad& is_bad, const Refuse& refuse)
      : study_(study), whole_(whole), moves_(moves), is_bad_(is_bad), refuse_(refuse) {}

  void all() {
    operating_point();
    if (auto* branches = std::get_if<studies::BranchesOptions>(&study_.plan)) lists_of(*branches);
    for_each_axis(study_, [this](std::string& name, double& from, double& to, const std::string& place) {
      range(name, from, to, place);
    });
  }

 private:
  void operating_point() {
    for (const SpeedAlias& alias : speed_aliases()) {
      const std::string place = std::string(operation_root) + "/" + std::string(alias.key);
      if (const auto value = std::exchange(study_.given_speed.*alias.given, std::nullopt);
          value && moves_ && !is_bad_(place))
        if (const auto ratio = ratio_of(alias, *value, place)) study_.mesh_frequency_ratio = *ratio;
    }
  }

  /// Before its axis, whose parameter is renamed.
  void lists_of(studies::BranchesOptions& b) {
    const SpeedAlias* alias = find_speed_alias(b.parameter);
    each(alias, b.starts, "/study/starts");
    each(alias, b.values, "/study/values");
    if (b.search) each(alias, b.search->values, "/study/search/values");
    if (b.loci) each(alias, b.loci->near, "/study/loci/near");
    for (std::size_t k = 0; k < b.seeds.size() && alias != nullptr && moves_; ++k) {
      studies::BranchSeed& seed = b.seeds[k];
      const std::string place = "/study/seeds/" + std::to_string(k);
      seed.value = axis_ratio_of(*alias, seed.value, place + "/value").value_or(1.0);
      if (seed.reach) seed.reach = axis_ratio_of(*alias, *seed.reach, place + "/reach").value_or(1.0);
    }
  }

  void each(const SpeedAlias* alias, std::vector<double>& values, const std::string& place) {
    if (alias == nullptr || !moves_) return;
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = axis_ratio_of(*alias, values[k], place + "/" + std::to_string(k)).value_or(1.0);
  }

  void range(std::string& name, double& from, double& to, const std::string& place) {
    const SpeedAlias* alias = find_speed_alias(name);
    if (alias == nullptr) return;
    name = studies::speed_parameter;
    if (moves_)
      if (const auto per_unit = ratio_per_unit(*alias, study_.stage))
        study_.axis_speed = studies::SpeedUnit{std::string(alias->key), 1.0 / *per_unit};
    const json& object = *find_at(whole_, place);
    const studies::Axis standard = studies::SweepOptions{}.axis;
    if (object.contains("from") && object.contains("to") && !is_bad_(place + "/from") && !is_bad_(place + "/to") &&
        from > to)
      refuse_(Finding::Kind::rule, place + "/from", "is " + number_text(from) + ", must be <= to = " + number_text(to));
    for (const auto& [key, value, otherwise] : {std::tuple("from", &from, standard.from), {"to", &to, standard.to}}) {
      const double given = std::exchange(*value, otherwise);
      const std::string at = place + "/" + key;
      if (!object.contains(key)) {
        // Elsewhere its table has reported it.
        refuse_(Finding::Kind::missing_key, at,
                place == "/study" ? "is missing; " + std::string(alias->key) + " needs a range of its own" : "");
      } else if (moves_ && !is_bad_(at)) {
        *value = axis_ratio_of(*alias, given, at).value_or(otherwise);
      }
    }
  }

  /// Omega at a speed that stands at a pointer; nothing where it is out of range, which is reported.
  std::optional<double> ratio_of(const SpeedAlias& alias, double value, const std::string& pointer) {
    const std::optional<double> per_unit = ratio_per_unit(alias, study_.stage);
    const studies::NamedParameter& speed = *studies::find_parameter(studies::speed_parameter);
    const Bounds bounds = between(speed.least, speed.most);
    if (!per_unit) {
      refuse_(Finding::Kind::range, pointer, "is a speed of a member that stands still in this stage");
      return std::nullopt;
    }
    const double ratio = value * *per_unit;
    if (bounds.contains(ratio)) return ratio;
    refuse_(Finding::Kind::range, pointer,
            "is " + number_text(value) + ", with which the mesh frequency ratio is " + number_text(ratio) +
                ", must be " + bounds.text());
    return std::nullopt;
  }

  /// The same along an axis: to as many digits as the values between its ends have, so that a longer range has the same
  /// values and an end is one of them.
  std::optional<double> axis_ratio_of(const SpeedAlias& alias, double value, const std::string& pointer) {
    const std::optional<double> ratio = ratio_of(alias, value, pointer);
    constexpr double between_ends = 0.5;
    return ratio ? std::optional(studies::grid_value(*ratio, *ratio, between_ends)) : std::nullopt;
  }

  Study& study_;
  const json& whole_;
  bool moves_;
  const IsBad& is_bad_;
  const Refuse& refuse_;
};

}  // namespace

void drop_other_speeds(json& whole, const std::string& key) {
  const auto is_speed = [](std::string_view k) {
    return k == studies::speed_parameter || find_speed_alias(k) != nullptr;
  };
  const auto operation = whole.find("operation");
  if (!is_speed(key) || operation == whole.end() || !operation->is_object()) return;
  std::vector<std::string> others;
  for (const auto& [other, value] : operation->items())
    if (is_speed(other) && other != key) others.push_back(other);
  for (const std::string& other : others) (void)assign(whole, std::string(operation_root) + "/" + other, nullptr);
}

void name_speed(std::string& parameter) {
  if (pointer_parent(parameter) != operation_root) return;
  const std::string key = pointer_leaf(parameter);
  if (key == studies::speed_parameter || find_speed_alias(key) != nullptr) parameter = key;
}

void name_speeds(Study& study) {
  for_each_axis(study,
                [](std::string& name, double& /*from*/, double& /*to*/, const char* /*place*/) { name_speed(name); });
  if (const auto* added = std::get_if<AddedPlan>(&study.plan)) added->kind->name_speeds(study);
}

void convert_speeds(Study& study, const json& whole, bool moves, const IsBad& is_bad, const Refuse& refuse) {
  Conversion(study, whole, moves, is_bad, refuse).all();
}

}  // namespace epicyclic::input
