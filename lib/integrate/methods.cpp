#include "integrate/methods.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace epicyclic::integrate {

const std::vector<Method>& methods() {
  using enum Family;
  static const std::vector<Method> all = {
      {"arkode-heun-euler", erk, "ARKODE_HEUN_EULER_2_1_2", 2, 1, 2},
      {"arkode-bogacki-shampine", erk, "ARKODE_BOGACKI_SHAMPINE_4_2_3", 3, 2, 4},
      {"arkode-ark324", erk, "ARKODE_ARK324L2SA_ERK_4_2_3", 3, 2, 4},
      {"arkode-zonneveld", erk, "ARKODE_ZONNEVELD_5_3_4", 4, 3, 5},
      {"arkode-ark436", erk, "ARKODE_ARK436L2SA_ERK_6_3_4", 4, 3, 6},
      {"arkode-ark437", erk, "ARKODE_ARK437L2SA_ERK_7_3_4", 4, 3, 7},
      {"arkode-sayfy-aburub", erk, "ARKODE_SAYFY_ABURUB_6_3_4", 4, 3, 6, true},
      {"arkode-cash-karp", erk, "ARKODE_CASH_KARP_6_4_5", 5, 4, 6},
      {"arkode-fehlberg45", erk, "ARKODE_FEHLBERG_6_4_5", 5, 4, 6},
      {"arkode-dopri5", erk, "ARKODE_DORMAND_PRINCE_7_4_5", 5, 4, 7},
      {"arkode-ark548", erk, "ARKODE_ARK548L2SA_ERK_8_4_5", 5, 4, 8},
      {"arkode-ark548b", erk, "ARKODE_ARK548L2SAb_ERK_8_4_5", 5, 4, 8},
      {"arkode-verner65", erk, "ARKODE_VERNER_8_5_6", 6, 5, 8},
      {"arkode-fehlberg78", erk, "ARKODE_FEHLBERG_13_7_8", 8, 7, 13, true},
      {"arkode-sdirk21", dirk, "ARKODE_SDIRK_2_1_2", 2, 1, 2},
      {"arkode-kvaerno3", dirk, "ARKODE_KVAERNO_4_2_3", 3, 2, 4},
      {"arkode-esdirk324", dirk, "ARKODE_ESDIRK324L2SA_4_2_3", 3, 2, 4},
      {"arkode-cash4", dirk, "ARKODE_CASH_5_3_4", 4, 3, 5},
      {"arkode-sdirk4", dirk, "ARKODE_SDIRK_5_3_4", 4, 3, 5, true},
      {"arkode-kvaerno4", dirk, "ARKODE_KVAERNO_5_3_4", 4, 3, 5},
      {"arkode-esdirk436", dirk, "ARKODE_ESDIRK436L2SA_6_3_4", 4, 3, 6},
      {"arkode-esdirk437", dirk, "ARKODE_ESDIRK437L2SA_7_3_4", 4, 3, 7},
      {"arkode-kvaerno5", dirk, "ARKODE_KVAERNO_7_4_5", 5, 4, 7},
      {"arkode-esdirk547", dirk, "ARKODE_ESDIRK547L2SA_7_4_5", 5, 4, 7},
      {"arkode-esdirk547b", dirk, "ARKODE_ESDIRK547L2SA2_7_4_5", 5, 4, 7},
      {"cvode-adams", adams, "", 12, 0, 0},
      {"cvode-bdf", bdf, "", 5, 0, 0},
      {"lanes-dopri5", lanes, "", 5, 4, 7},
      {"lanes-cash-karp", lanes, "", 5, 4, 6},
  };
  return all;
}

const Method* find_method(std::string_view name) {
  const auto& all = methods();
  const auto it = std::find_if(all.begin(), all.end(), [&](const Method& m) { return m.name == name; });
  return it == all.end() ? nullptr : &*it;
}

const Method& method_named(std::string_view name) {
  if (const Method* method = find_method(name)) return *method;
  std::string message = "method = '" + std::string(name) + "', must be one of";
  for (const Method& m : methods()) message.append(" ").append(m.name);
  throw InputError(message);
}

std::string arkode_twin(std::string_view method) {
  constexpr std::string_view lanes = "lanes-";
  return method.starts_with(lanes) ? "arkode-" + std::string(method.substr(lanes.size())) : std::string(method);
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const auto& m : methods()) names.emplace_back(m.name);
  return names;
}

}  // namespace epicyclic::integrate
