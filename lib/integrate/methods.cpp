#include "integrate/methods.hpp"

#include <algorithm>

namespace epicyclic::integrate {

const std::vector<ErkMethod>& erk_methods() {
  static const std::vector<ErkMethod> methods = {
      {"arkode-heun-euler", "ARKODE_HEUN_EULER_2_1_2", 2, 1, 2},
      {"arkode-bogacki-shampine", "ARKODE_BOGACKI_SHAMPINE_4_2_3", 3, 2, 4},
      {"arkode-ark324", "ARKODE_ARK324L2SA_ERK_4_2_3", 3, 2, 4},
      {"arkode-zonneveld", "ARKODE_ZONNEVELD_5_3_4", 4, 3, 5},
      {"arkode-ark436", "ARKODE_ARK436L2SA_ERK_6_3_4", 4, 3, 6},
      {"arkode-sayfy-aburub", "ARKODE_SAYFY_ABURUB_6_3_4", 4, 3, 6},
      {"arkode-cash-karp", "ARKODE_CASH_KARP_6_4_5", 5, 4, 6},
      {"arkode-fehlberg45", "ARKODE_FEHLBERG_6_4_5", 5, 4, 6},
      {"arkode-dopri5", "ARKODE_DORMAND_PRINCE_7_4_5", 5, 4, 7},
      {"arkode-ark548", "ARKODE_ARK548L2SA_ERK_8_4_5", 5, 4, 8},
      {"arkode-verner65", "ARKODE_VERNER_8_5_6", 6, 5, 8},
      {"arkode-fehlberg78", "ARKODE_FEHLBERG_13_7_8", 8, 7, 13},
  };
  return methods;
}

const ErkMethod* find_erk_method(std::string_view name) {
  const auto& all = erk_methods();
  const auto it = std::find_if(all.begin(), all.end(), [&](const ErkMethod& m) { return m.name == name; });
  return it == all.end() ? nullptr : &*it;
}

std::vector<std::string> arkode_method_names() {
  std::vector<std::string> names;
  for (const auto& m : erk_methods()) names.emplace_back(m.name);
  return names;
}

}  // namespace epicyclic::integrate
