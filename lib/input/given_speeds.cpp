#include "input/given_speeds.hpp"

#include <tuple>
#include <utility>

#include "input/pointers.hpp"
#include "input/study_kind.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::input {

namespace {

using nlohmann::json;
using Refuse = std::function<void(Finding::Kind, const std::string&, std::string)>;

class Conversion {
 public:
  Conversion(Study& study, const json& whole, bool moves, const IsBad& is_bad, const Refuse& refuse)
      : study_(study), whole_(whole), moves_(moves), is_bad_(is_bad), refuse_(refuse) {}

  void all() {
    operating_point();
    values();
    for (const PlanAxis& axis : axes_of(study_.plan)) range(*axis.name, *axis.from, *axis.to, axis.place);
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

  /// Before the axes, whose parameter is renamed.
  void values() {
    const StudyKind* kind = study_.plan.kind();
    if (kind == nullptr || kind->values == nullptr || !moves_) return;
    const SpeedAlias* alias = find_speed_alias(*axes_of(study_.plan).front().name);
    if (alias == nullptr) return;
    for (const PlacedNumber& number : kind->values(study_.plan.options()))
      *number.value = axis_ratio_of(*alias, *number.value, number.place).value_or(1.0);
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

  /// Omega at the speed at a pointer; nothing if it is out of range, which is reported.
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
  for (const PlanAxis& axis : axes_of(study.plan)) name_speed(*axis.name);
  if (const StudyKind* kind = study.plan.kind(); kind != nullptr && kind->name_speeds != nullptr)
    kind->name_speeds(study);
}

void convert_speeds(Study& study, const json& whole, bool moves, const IsBad& is_bad, const Refuse& refuse) {
  Conversion(study, whole, moves, is_bad, refuse).all();
}

}  // namespace epicyclic::input
