// The kind of study "continue": branches of periodic orbits along one parameter.

#include "input/plan_tables.hpp"
#include "input/study_kind.hpp"
#include "integrate/methods.hpp"
#include "kinds/list.hpp"
#include "studies/branches_options.hpp"

namespace epicyclic::kinds {

using namespace input;
using studies::BranchesOptions;

namespace {

constexpr double period_most = 1024;
constexpr std::size_t seeds_most = 10000;

const Table<studies::BranchSeed>& seed_table() {
  static const auto table = [] {
    using studies::BranchSeed;
    Table<BranchSeed> t("seed", "A state on or near a periodic orbit.");
    t.number("value", &BranchSeed::value, any_value, "Value of the parameter, in its unit.").required();
    t.integer("period", &BranchSeed::period, between(1, period_most), "Period of the orbit, in mesh periods [-].");
    t.numbers("state", &BranchSeed::state, component_value, 1, 1000,
              "The state at the mesh phase 0, in the order of poincare.csv [b_c, b_c per tau].")
        .required();
    t.number("max_distance", &BranchSeed::max_distance, between(1e-300, 1e300),
             "Distance from the value up to which its branches are continued, in the parameter's unit; by default to "
             "the ends of the range.");
    return t;
  }();
  return table;
}

const Table<studies::BranchSearchOptions>& search_table() {
  static const auto table = [] {
    using studies::BranchSearchOptions;
    Table<BranchSearchOptions> t("search", "A search for coexisting periodic orbits, stable or not.");
    t.numbers("values", &BranchSearchOptions::values, any_value, 1, 1000,
              "Values of the parameter at which the search is made.")
        .required();
    t.integer("starts", &BranchSearchOptions::starts, between(1, 1e6),
              "Starts of Newton's method: half of them on an attractor, half of them random about it [-].");
    t.number("spread", &BranchSearchOptions::spread, between(0, 1e6),
             "Half width of the box of the random starts, in b_c and b_c per tau.");
    t.integer("period_max", &BranchSearchOptions::period_max, between(1, period_most),
              "Longest period that is sought, in mesh periods [-].");
    return t;
  }();
  return table;
}

/// A part of branches that there may be.
template <class U>
table_detail::Access<Study, U> in_branches(std::optional<U> BranchesOptions::*member) {
  return {[=](Study& s) -> U& {
            auto& held = s.plan.as<BranchesOptions>().*member;
            return held ? *held : held.emplace();
          },
          [=](const Study& s) -> const U* {
            const auto& held = s.plan.as<BranchesOptions>().*member;
            return held ? &*held : nullptr;
          }};
}

const Table<studies::LociOptions>& loci_table() {
  static const auto table = [] {
    using analysis::SpecialKind;
    using studies::LociOptions;
    Table<LociOptions> t("loci", "Loci of the special points over a second parameter.");
    t.text("parameter", &LociOptions::parameter,
           "Name of the second parameter, or a JSON pointer to a number of the input.")
        .required();
    t.number("from", &LociOptions::from, any_value, "Its least value, in its unit.").required();
    t.number("to", &LociOptions::to, any_value, "Its greatest value, in its unit.").required();
    std::vector<std::pair<std::string, SpecialKind>> kinds;
    for (const auto kind : {SpecialKind::fold, SpecialKind::period_doubling, SpecialKind::neimark_sacker,
                            SpecialKind::branch_point, SpecialKind::grazing})
      kinds.emplace_back(to_string(kind), kind);
    t.choices("kinds", &LociOptions::kinds, kinds, "Kinds of points whose loci are continued.");
    t.numbers("near", &LociOptions::near, any_value, 0, 1000,
              "Values of the first parameter: only the points nearest to them have loci; by default all points.");
    t.integer("points", &LociOptions::points, between(1, 1e6),
              "Largest number of points on a locus, in each direction [-].");
    return t;
  }();
  return table;
}

const Table<Study>& continue_table() {
  static const auto table = [] {
    Table<Study> t("continue", "Branches of periodic orbits along one parameter, with their special points.");
    add_kind_key(t, "continue");
    const auto of = [](auto member) { return in_plan(whole_plan<BranchesOptions>, member); };
    t.text("parameter", of(&BranchesOptions::parameter), parameter_words);
    t.number("from", of(&BranchesOptions::from), any_value, "Least value of the parameter, in its unit.");
    t.number("to", of(&BranchesOptions::to), any_value, "Greatest value of the parameter, in its unit.");
    t.numbers("starts", of(&BranchesOptions::starts), any_value, 0, 1000,
              "Values at which an attractor is reached from the default start and its orbit continued in both "
              "directions. By default, without seeds: the ends of the range and its middle.");
    t.integer("transient_periods", of(&BranchesOptions::transient_periods), between(0, 1e7),
              "Mesh periods of the transient at these values [-].");
    t.integer("period", of(&BranchesOptions::period), between(1, period_most),
              "Period of these orbits, in mesh periods [-].");
    t.objects("seeds", of(&BranchesOptions::seeds), seed_table(), seeds_most,
              "Further states from which branches start; `--from FOLDER` writes them.");
    t.numbers("values", of(&BranchesOptions::values), any_value, 1, 100000,
              "Values at which orbits are computed exactly.");
    t.integer("period_max", of(&BranchesOptions::period_max), between(1, period_most),
              "Longest period of branches that are continued from period doublings, in mesh periods [-].");
    t.boolean("branch_points", of(&BranchesOptions::branch_points),
              "Whether branches that cross at branch points are continued.");
    t.integer("shooting_intervals", of(&BranchesOptions::shooting_intervals), between(1, 1000),
              "Shooting intervals of an orbit of `period`, for multiple shooting [-].");
    t.integer("orbits", of(&BranchesOptions::orbits), between(1, 1e6),
              "Largest number of orbits on a branch, in each direction [-].");
    t.integer("branches", of(&BranchesOptions::branches), between(1, 10000), "Largest number of branches [-].");
    t.choice("method", of(&BranchesOptions::method), integrate::method_names(),
             "Method of integration; one that can ends its steps where contact is made or lost.");
    t.number("tolerance", of(&BranchesOptions::tolerance), between(1e-13, 1e-6),
             "Relative and absolute tolerance of the orbits [-]; error bounds are from a tenth of it.");
    t.number("max_step", of(&BranchesOptions::max_step), between(1e-6, 10),
             "Longest step along a branch, in units of the parameter and of b_c together [-].");
    t.integer("output_phases", of(&BranchesOptions::output_phases), between(1, 10000),
              "Samples per mesh period for means; extrema have at least four times as many [-].");
    t.object("search", in_branches(&BranchesOptions::search), search_table());
    t.object("loci", in_branches(&BranchesOptions::loci), loci_table());
    return t;
  }();
  return table;
}

/// Rules of branches that span their keys.
void check_branches(const Study& study, const IsBad& is_bad, ReadContext& context) {
  const auto& b = study.plan.as<BranchesOptions>();
  const gear::Stage& stage = study.stage;
  if (is_bad("/study")) return;
  const auto refuse = [&](const std::string& place, const std::string& message) {
    if (!is_bad(place)) context.add(Finding::Kind::rule, place, message);
  };
  const bool has_range = !is_bad("/study/from") && !is_bad("/study/to");
  if (has_range && !(b.from < b.to))
    refuse("/study/from", "is " + number_text(b.from) + ", must be < to = " + number_text(b.to));
  const auto outside = [&](double value) { return has_range && b.from < b.to && !(value >= b.from && value <= b.to); };
  const std::string range = ", must be within from = " + number_text(b.from) + " and to = " + number_text(b.to);
  const auto check_each = [&](const std::string& place, const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k)
      if (outside(values[k])) refuse(place + "/" + std::to_string(k), "is " + number_text(values[k]) + range);
  };
  check_each("/study/starts", b.starts);
  check_each("/study/values", b.values);
  if (b.search) check_each("/study/search/values", b.search->values);
  if (b.period_max < b.period)
    refuse("/study/period_max",
           "is " + std::to_string(b.period_max) + ", must be >= period = " + std::to_string(b.period));
  for (std::size_t k = 0; k < b.seeds.size(); ++k) {
    const studies::BranchSeed& seed = b.seeds[k];
    const std::string place = "/study/seeds/" + std::to_string(k);
    if (outside(seed.value)) refuse(place + "/value", "is " + number_text(seed.value) + range);
    if (seed.max_distance &&
        !(seed.value - *seed.max_distance < seed.value && seed.value + *seed.max_distance > seed.value))
      refuse(place + "/max_distance", "is " + number_text(*seed.max_distance) + ", which is nothing beside the value");
    if (std::string why = why_no_state(seed.state, stage); !why.empty()) refuse(place + "/state", why);
  }
  if (!is_bad("/study/parameter"))
    check_named_parameter(studies::Axis{b.parameter, b.from, b.to, 2}, "/study", is_bad, context);
  if (!b.loci || is_bad("/study/loci")) return;
  const studies::LociOptions& loci = *b.loci;
  if (!is_bad("/study/loci/from") && !is_bad("/study/loci/to") && !(loci.from < loci.to))
    refuse("/study/loci/from", "is " + number_text(loci.from) + ", must be < to = " + number_text(loci.to));
  check_each("/study/loci/near", loci.near);
  if (is_bad("/study/parameter") || is_bad("/study/loci/parameter")) return;
  check_named_parameter(studies::Axis{loci.parameter, loci.from, loci.to, 2}, "/study/loci", is_bad, context);
  check_different(b.parameter, loci.parameter, "/study/loci/parameter", context);
}

std::vector<PlanAxis> branch_axes(std::any& options) {
  // So many values of the range are tried before anything is begun.
  constexpr int tried = 33;
  auto& b = std::any_cast<BranchesOptions&>(options);
  std::vector<PlanAxis> all = {{&b.parameter, &b.from, &b.to, tried, "/study"}};
  if (auto& loci = b.loci) all.push_back({&loci->parameter, &loci->from, &loci->to, tried, "/study/loci"});
  return all;
}

std::vector<PlacedNumber> branch_values(std::any& options) {
  auto& b = std::any_cast<BranchesOptions&>(options);
  std::vector<PlacedNumber> all;
  const auto add = [&](std::vector<double>& list, const std::string& place) {
    for (std::size_t k = 0; k < list.size(); ++k) all.push_back({&list[k], place + "/" + std::to_string(k)});
  };
  add(b.starts, "/study/starts");
  add(b.values, "/study/values");
  if (b.search) add(b.search->values, "/study/search/values");
  if (b.loci) add(b.loci->near, "/study/loci/near");
  for (std::size_t k = 0; k < b.seeds.size(); ++k) {
    const std::string place = "/study/seeds/" + std::to_string(k);
    all.push_back({&b.seeds[k].value, place + "/value"});
    if (b.seeds[k].max_distance) all.push_back({&*b.seeds[k].max_distance, place + "/max_distance"});
  }
  return all;
}

void warn_of_branches(std::vector<gear::Warning>& out, const LoadedInput& input) {
  const integrate::IntegratorOptions& own = input.study.integrator;
  const integrate::IntegratorOptions plain;
  if (own.method != plain.method || own.relative_tolerance != plain.relative_tolerance ||
      own.absolute_tolerance != plain.absolute_tolerance || own.locate_contacts != plain.locate_contacts)
    out.push_back({gear::Rank::doubtful, 1.0, "/integrator", "branches",
                   "method and tolerances are not used: branches are integrated by /study/method at /study/tolerance"});
}

}  // namespace

const StudyKind& continue_kind() {
  static const StudyKind kind = {
      .name = "continue",
      .table = &continue_table,
      .defaults = BranchesOptions{},
      .axes = &branch_axes,
      .values = &branch_values,
      .method = [](const std::any& options) -> const std::string& {
        return std::any_cast<const BranchesOptions&>(options).method;
      },
      .check = &check_branches,
      .warn = &warn_of_branches,
      .cost =
          [](const LoadedInput& /*input*/) {
            return std::string(
                "that of branches is not known before they are continued; `orbits` and `branches` bound it");
          },
      .plot = {PlotForm::curves, {"branch.csv", "poincare.csv"}, "delta_sp_rms"},
  };
  return kind;
}

}  // namespace epicyclic::kinds
