// The tables of a study of claims (options.hpp): keys, units, bounds, meaning.

#include "claims/judging.hpp"
#include "claims/kind.hpp"
#include "input/plan_tables.hpp"

namespace epicyclic::claims {

using input::above_up_to;
using input::between;
using input::Bounds;
using input::Field;
using input::named;
using input::ReadContext;
using input::Study;
using input::Table;
namespace table_detail = input::table_detail;

namespace {

const Bounds any_value = between(-1e300, 1e300);
constexpr std::size_t list_most = 1000;

/// Any JSON value, kept as its text.
Field<OptionSet> value_field() {
  Field<OptionSet> field;
  field.key = "value";
  field.description = "What stands there instead.";
  field.read = [](const nlohmann::json& value, const std::string&, OptionSet& set, ReadContext&) {
    set.value = value.dump();
  };
  field.write = [](const OptionSet& set) { return nlohmann::json::parse(set.value, nullptr, false); };
  field.schema = [] { return nlohmann::ordered_json::object(); };
  return field;
}

const Table<OptionSet>& option_set_table() {
  static const auto table = [] {
    Table<OptionSet> t("option_set", "A value of the input that is replaced.");
    t.text("pointer", &OptionSet::pointer, "JSON pointer to it.").required();
    t.custom(value_field()).required();
    return t;
  }();
  return table;
}

const Table<SetValue>& set_value_table() {
  static const auto table = [] {
    Table<SetValue> t("set_value", "A value in place of the study's.");
    t.text("parameter", &SetValue::parameter, "Name of the parameter, or a JSON pointer to a number of the input.")
        .required();
    t.number("value", &SetValue::value, any_value, "Its value, in its unit.");
    t.text("same_as", &SetValue::same_as,
           "Instead of a value: JSON pointer to a number of the input that it is to be like.");
    return t;
  }();
  return table;
}

/// Of conditions.
std::vector<std::string> quantity_names() {
  std::vector<std::string> names(claim_quantities.begin(), claim_quantities.end());
  names.insert(names.end(), column_quantities().begin(), column_quantities().end());
  return names;
}

const Table<Condition>& condition_table() {
  static const auto table = [] {
    Table<Condition> t("condition", "A condition on a sweep.");
    t.choice("kind", &Condition::kind, named<ConditionKind>(condition_kinds),
             "What is measured. Of regimes: share, count, change, sequence, variation between neighbours, agreement of "
             "both kinds of mesh. Of a quantity: a statistic (value), reduction, peaks, jump, decreasing from sweep to "
             "sweep, published values (curve). Of a stage: published natural frequencies.")
        .required();
    t.text("sweep", &Condition::sweep, "The sweep, by its name.");
    t.texts("sweeps", &Condition::sweeps, list_most, "Sweeps one after the other, for decreasing.");
    t.number("from", &Condition::from, any_value, "Least value of the sweep's parameter that counts; from its start.");
    t.number("to", &Condition::to, any_value, "Greatest value of the sweep's parameter that counts; to its end.");
    t.text("regime", &Condition::regime,
           "Regime: period N, periodic, multi-period, quasiperiodic, chaotic, aperiodic, or not and one of these.");
    t.text("regime_after", &Condition::regime_after, "Regime after a change.");
    t.text("leads_to", &Condition::leads_to,
           "Regime that follows a change, before the regime before the change returns.");
    t.texts("regimes", &Condition::regimes, list_most, "Regimes of a sequence.");
    t.choice("which", &Condition::which,
             std::vector<std::pair<std::string, Which>>{{"first", Which::first}, {"last", Which::last}},
             "Of several changes, along the rising parameter.");
    t.numbers("within", &Condition::within, any_value, 1, 2, "Least and greatest value of a change.");
    t.number("at_least", &Condition::at_least, any_value, "Least that is measured.");
    t.number("at_most", &Condition::at_most, any_value, "Most that is measured.");
    t.choice("quantity", &Condition::quantity, quantity_names(),
             "Of planet 1: range and maximum of the deflections in time, range of their Poincare points [b_c]. Spread "
             "of the planets [b_c]. Largest Lyapunov exponent [per tau]. Or a column of points.csv, in its unit.");
    t.choice("statistic", &Condition::statistic,
             std::vector<std::pair<std::string, Statistic>>{
                 {"min", Statistic::min}, {"mean", Statistic::mean}, {"max", Statistic::max}},
             "Of the quantity over the points.");
    t.numbers("peak_locations", &Condition::peak_locations, any_value, 1, list_most, "Values where peaks are claimed.");
    t.number("location_tolerance", &Condition::location_tolerance, between(0, 1),
             "Relative distance of a peak from one [-].");
    t.number("prominence", &Condition::prominence, between(0, 1), "Of a peak, in parts of the largest value [-].");
    t.number("correlation", &Condition::correlation, between(-1, 1), "Least correlation of both ranges [-].");
    t.numbers("data_at", &Condition::data_at, any_value, 1, list_most,
              "Values of the sweep's parameter at which a curve is published.");
    t.numbers("data", &Condition::data, any_value, 1, list_most,
              "Published values of the quantity there, in its unit.");
    t.number("tolerance", &Condition::tolerance, above_up_to(0, 1e6),
             "Largest difference from the data, in parts of the largest value of the data [-].");
    t.choice("direction", &Condition::direction, input::direction_choices(), "Direction of the sweep with the curve.");
    t.text("stage", &Condition::stage, "The stage of the frequencies, by its name.");
    t.choice("mode_type", &Condition::mode_type, std::vector<std::string>(mode_types.begin(), mode_types.end()),
             "Type of the modes; all if it is not given.");
    t.numbers("frequencies_Hz", &Condition::frequencies_Hz, between(0, 1e12), 1, list_most,
              "All published natural frequencies of that type, a multiple one once [Hz].");
    t.numbers("tolerance_Hz", &Condition::tolerance_Hz, above_up_to(0, 1e12), 1, list_most,
              "Largest difference from a frequency: one for all of them, or one each [Hz].");
    t.integer("multiplicity", &Condition::multiplicity, between(1, 64), "Multiplicity of each of them [-].");
    return t;
  }();
  return table;
}

const Table<ParameterTarget>& target_table() {
  static const auto table = [] {
    Table<ParameterTarget> t("target", "A number of the input that a parameter gives: factor x^power.");
    t.text("pointer", &ParameterTarget::pointer, "JSON pointer to the number.").required();
    t.number("factor", &ParameterTarget::factor, any_value, "Factor [-].");
    t.number("power", &ParameterTarget::power, between(-10, 10), "Power [-].");
    t.text("times", &ParameterTarget::times, "Name of another parameter that it is multiplied with.");
    return t;
  }();
  return table;
}

const Table<ClaimPanel>& panel_table() {
  static const auto table = [] {
    Table<ClaimPanel> t("claim_panel",
                        "A bifurcation diagram of the deflection of planet 1's mesh; or a quantity along a sweep, or "
                        "the natural frequencies of a stage, with the published numbers of the claims.");
    t.text("sweep", &ClaimPanel::sweep, "The sweep, by its name.");
    t.choice("quantity", &ClaimPanel::quantity, quantity_names(),
             "Instead of a bifurcation diagram: along the sweep, in all its directions.");
    t.text("stage", &ClaimPanel::stage, "Instead of a sweep: the natural frequencies of this stage.");
    t.choice("mesh", &ClaimPanel::mesh,
             std::vector<std::pair<std::string, MeshSide>>{{"sun_planet", MeshSide::sun_planet},
                                                           {"ring_planet", MeshSide::ring_planet}},
             "Which mesh.");
    t.text("title", &ClaimPanel::title, "What it shows.");
    return t;
  }();
  return table;
}

const Table<ChoiceOption>& option_table() {
  static const auto table = [] {
    Table<ChoiceOption> t("option", "One of the readings.");
    t.text("name", &ChoiceOption::name, "Name of the option.").required();
    t.number("odds", &ChoiceOption::odds, above_up_to(0, 1e6), "How likely it is, beside the others' odds [-].");
    t.objects("sets", &ChoiceOption::sets, option_set_table(), list_most, "What it replaces in the input.");
    return t;
  }();
  return table;
}

}  // namespace

const Table<ClaimSweep>& claim_sweep_table() {
  static const auto table = [] {
    using studies::Axis;
    Table<ClaimSweep> t("claim_sweep", "A sweep that claims speak of.");
    const auto of = [](auto member) {
      return [member](auto& sweep) -> auto& { return sweep.axis.*member; };
    };
    t.text("name", &ClaimSweep::name, "Its name; its folder is called so.").required();
    t.text("parameter", of(&Axis::name), "Name of the parameter, or a JSON pointer to a number of the input.")
        .required();
    t.number("from", of(&Axis::from), any_value, "First value, in its unit.").required();
    t.number("to", of(&Axis::to), any_value, "Last value, in its unit.").required();
    t.integer("points", of(&Axis::points), between(2, 100000), "Number of points, evenly spaced, ends included [-].");
    t.objects("sets", &ClaimSweep::sets, option_set_table(), list_most,
              "Values of any kind that differ from the study, such as an array for another number of planets.");
    t.objects("at", &ClaimSweep::at, set_value_table(), list_most, "Numbers that differ from that.");
    t.choices("directions", &ClaimSweep::directions, input::direction_choices(),
              "Directions of the sweep with continued initial states.");
    t.integer("recorded_periods", &ClaimSweep::recorded_periods, between(1, 1e5),
              "Mesh periods recorded of each point [-]; as the study if it is not given. Extrema of chaos take long "
              "records.");
    t.integer("screening_points", &ClaimSweep::screening_points, between(2, 100000),
              "Points of the sweep in a screening [-].");
    t.integer("survey_points", &ClaimSweep::survey_points, between(2, 100000), "Points of the sweep in a survey [-].");
    t.integer(
        "screening_round", &ClaimSweep::screening_round, between(0, 1000),
        "Round of the screening: a later round is computed if the earlier ones do not rule the candidate out [-].");
    return t;
  }();
  return table;
}

namespace {

const Table<ClaimStage>& claim_stage_table() {
  static const auto table = [] {
    Table<ClaimStage> t("claim_stage", "A stage whose natural frequencies claims speak of.");
    t.text("name", &ClaimStage::name, "Its name.").required();
    t.objects("sets", &ClaimStage::sets, option_set_table(), list_most,
              "Values of any kind that differ from the study.");
    t.objects("at", &ClaimStage::at, set_value_table(), list_most, "Numbers that differ from that.");
    return t;
  }();
  return table;
}

std::vector<std::pair<std::string, Reading>> reading_choices() {
  return {{"evidence", Reading::evidence}, {"printed", Reading::printed}};
}

const Table<PrintedDots>& printed_dots_table() {
  static const auto table = [] {
    Table<PrintedDots> t("printed_dots", "The dots of a printed diagram, whose axis spans all its Poincare points.");
    t.number("dot", &PrintedDots::dot, above_up_to(0, 0.5), "Size of a dot, in parts of the axis [-].");
    t.number("height", &PrintedDots::height, above_up_to(0, 1),
             "Tallest cluster of dots that is one dot to a reader, in parts of the axis [-].");
    t.integer("period_max", &PrintedDots::period_max, between(1, 64), "Clusters that a reader counts [-].");
    t.numbers("other_dots", &PrintedDots::other_dots, above_up_to(0, 0.5), 0, 100,
              "Other sizes of a dot, for which the scorecard has the verdicts, too [-].");
    return t;
  }();
  return table;
}

}  // namespace

const Table<Claim>& claim_table() {
  static const auto table = [] {
    Table<Claim> t("claim", "A claim: it holds where all its conditions do.");
    t.text("name", &Claim::name, "Its name.").required();
    t.text("text", &Claim::text, "What is claimed.");
    t.text("where", &Claim::where, "Where it is published.");
    t.text("published", &Claim::published, "The value that is published.");
    t.number("weight", &Claim::weight, between(0, 1e6), "Weight of its cost in a search [-].");
    t.objects("conditions", &Claim::conditions, condition_table(), list_most, "Its conditions.").required();
    t.objects("as_printed", &Claim::as_printed, condition_table(), list_most,
              "Conditions that a reader of the printed diagram accepts instead of the others, all together.");
    return t;
  }();
  return table;
}

const Table<ClaimFigure>& claim_figure_table() {
  static const auto table = [] {
    Table<ClaimFigure> t("claim_figure", "A figure of panels under each other that have one parameter.");
    t.text("name", &ClaimFigure::name, "Of its file.").required();
    t.text("title", &ClaimFigure::title, "What it shows.");
    t.text("data", &ClaimFigure::data, "Word of the legend for the data, such as closed form.");
    t.objects("panels", &ClaimFigure::panels, panel_table(), 20, "Its panels, from above.").required();
    return t;
  }();
  return table;
}

namespace {

Table<Screening> screening_table_of(const char* name, const char* description) {
  Table<Screening> t(name, description);
  t.integer("transient_periods", &Screening::transient_periods, between(0, 1e6), "Mesh periods before the record [-].");
  t.integer("recorded_periods", &Screening::recorded_periods, between(4, 1e5), "Mesh periods recorded [-].");
  t.integer(
      "classification_periods", &Screening::classification_periods, between(0, 1e7),
      "Mesh periods after the record in which the regime may be classified [-]; 0: by recurrence and growth alone.");
  t.integer("growth_periods", &Screening::growth_periods, between(0, 1e6),
            "Mesh periods over which growth distinguishes chaos from other responses that do not recur [-]; 0: all "
            "that do not recur count as chaotic.");
  t.number("relative_tolerance", &Screening::relative_tolerance, between(1e-12, 1e-2),
           "Relative and absolute tolerance [-].");
  return t;
}

const Table<Screening>& survey_recording_table() {
  static const auto table =
      screening_table_of("survey_screening", "How draws are screened: from the default start, in lanes.");
  return table;
}

}  // namespace

const Table<Screening>& screening_table() {
  static const auto table =
      screening_table_of("screening", "How candidates of a search are screened: from the default start, in lanes.");
  return table;
}

const Table<SurveyOptions>& survey_options_table() {
  static const auto table = [] {
    Table<SurveyOptions> t("survey", "Draws from the ranges of the parameters.");
    t.integer("draws", &SurveyOptions::draws, between(1, 1e7), "Completions that are drawn [-].");
    t.integer("seed", &SurveyOptions::seed, between(0, 1e9), "Seed of their random numbers [-].");
    t.integer("confirmed", &SurveyOptions::confirmed, between(0, 1e6),
              "Number of first draws that are compared with whole sweeps, as a check of the screening [-].");
    t.choice("reading", &SurveyOptions::reading, reading_choices(), "How the claims are read.");
    t.object("screening", &SurveyOptions::recording, survey_recording_table());
    return t;
  }();
  return table;
}

const Table<FreeParameter>& free_parameter_table() {
  static const auto table = [] {
    Table<FreeParameter> t("free_parameter", "A parameter that is not published, with its range.");
    t.text("name", &FreeParameter::name, "Its name.").required();
    t.text("description", &FreeParameter::description, "What it is, with its unit.");
    t.text("reason", &FreeParameter::reason, "Why it has this range.");
    t.number("from", &FreeParameter::from, any_value, "Least value.").required();
    t.number("to", &FreeParameter::to, any_value, "Greatest value.").required();
    t.choice("scale", &FreeParameter::scale,
             std::vector<std::pair<std::string, ParameterScale>>{{"linear", ParameterScale::linear},
                                                                 {"logarithmic", ParameterScale::logarithmic}},
             "Whether the value or its logarithm is spread evenly over the range.");
    t.objects("targets", &FreeParameter::targets, target_table(), list_most, "Numbers of the input that it gives.");
    t.text("choice", &FreeParameter::choice, "It counts only where this choice ...");
    t.text("option", &FreeParameter::option, "... takes this option.");
    return t;
  }();
  return table;
}

const Table<Choice>& choice_table() {
  static const auto table = [] {
    Table<Choice> t("choice", "Readings between which what is published does not decide.");
    t.text("name", &Choice::name, "Its name.").required();
    t.text("reason", &Choice::reason, "Why there is a choice.");
    t.objects("options", &Choice::options, option_table(), 100, "The readings.").required();
    return t;
  }();
  return table;
}

const Table<SearchOptions>& search_options_table() {
  static const auto table = [] {
    Table<SearchOptions> t("claim_search", "A search for the parameters.");
    t.choice("method", &SearchOptions::method,
             std::vector<std::pair<std::string, SearchMethod>>{
                 {"differential_evolution", SearchMethod::differential_evolution},
                 {"covariance_adaptation", SearchMethod::covariance_adaptation}},
             "Method of the islands: a global search, or one that begins at the given stage.");
    t.choice(
        "regime_cost", &SearchOptions::regime_cost,
        std::vector<std::pair<std::string, SearchLead>>{
            {"regimes", SearchLead::regimes}, {"multipliers", SearchLead::multipliers}, {"dots", SearchLead::dots}},
        "What gives the cost of a failed condition on regimes. `regimes`: those of the screened points. "
        "`multipliers`: the Floquet multipliers of the orbit of period 1 along the sweeps. `dots`: heights and gaps "
        "of the dots in the diagrams.");
    t.choice("reading", &SearchOptions::reading, reading_choices(), "How the claims are read.");
    t.number("spread", &SearchOptions::spread, above_up_to(0, 1),
             "Of the first candidates of a covariance adaptation, in parts of the ranges [-].");
    t.integer("seed", &SearchOptions::seed, between(0, 1e9), "Seed of its random numbers [-].");
    t.integer("islands", &SearchOptions::islands, between(1, 1000), "Populations side by side [-].");
    t.integer("population", &SearchOptions::population, between(7, 10000), "Candidates of each [-].");
    t.integer("candidates", &SearchOptions::candidates, between(7, 1e8),
              "Candidates that they try in all, in whole generations of all islands, two at least [-].");
    t.integer("migration_interval", &SearchOptions::migration_interval, between(1, 1e6),
              "Generations between exchanges of the best [-].");
    t.integer("refinement", &SearchOptions::refinement, between(0, 1e6), "Candidates of the local refinement [-].");
    t.integer(
        "confirmed", &SearchOptions::confirmed, between(0, 10000),
        "Of the best candidates: held against whole sweeps, and the one that meets most claims is the result [-].");
    t.integer("profile", &SearchOptions::profile, between(0, 1000),
              "Values of each parameter in the profile of the cost through the result [-].");
    return t;
  }();
  return table;
}

namespace {

template <class V>
table_detail::Access<Study, V> of(V ClaimsOptions::*member) {
  return {[=](Study& s) -> V& { return claims_in(s).*member; },
          [=](const Study& s) -> const V* { return &(claims_in(s).*member); }};
}

template <class V>
table_detail::Access<Study, V> of(V ParameterSpace::*member) {
  return {[=](Study& s) -> V& { return claims_in(s).space.*member; },
          [=](const Study& s) -> const V* { return &(claims_in(s).space.*member); }};
}

}  // namespace

const Table<Study>& claims_table() {
  static const auto table = [] {
    Table<Study> t("claims",
                   "What is published of a stage, as claims on sweeps, and what it leaves unsaid, as ranges.");
    input::add_kind_key(t, claims_kind().name);
    t.choices("starts", of(&ClaimsOptions::starts), input::start_choices(),
              "Where points of sweeps start; the first gives the verdict, the other stands beside it.");
    t.choices("readings", of(&ClaimsOptions::readings), reading_choices(),
              "Where the regimes of points come from: evidence, or the dots of a printed diagram. The first gives the "
              "verdict, the other stands beside it.");
    t.object("printed", of(&ClaimsOptions::printed), printed_dots_table());
    input::add_recording(t);
    input::add_classification(t);
    t.objects("sweeps", of(&ClaimsOptions::sweeps), claim_sweep_table(), 1000, "Sweeps that the claims speak of.");
    t.objects("stages", of(&ClaimsOptions::stages), claim_stage_table(), 1000,
              "Stages whose natural frequencies the claims speak of.");
    t.objects("claims", of(&ClaimsOptions::claims), claim_table(), 1000, "What is claimed.").required();
    t.objects("figures", of(&ClaimsOptions::figures), claim_figure_table(), 100, "Figures as they are published.");
    t.object("screening", of(&ClaimsOptions::screening), screening_table());
    t.objects("parameters", of(&ParameterSpace::parameters), free_parameter_table(), 1000,
              "Numbers of the input that are not published, with their ranges.");
    t.objects("choices", of(&ParameterSpace::choices), choice_table(), 100,
              "Readings between which what is published does not decide.");
    t.object("search", of(&ClaimsOptions::search), search_options_table());
    t.object("survey", of(&ClaimsOptions::survey), survey_options_table());
    return t;
  }();
  return table;
}

}  // namespace epicyclic::claims
