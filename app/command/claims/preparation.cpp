#include "preparation.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "claims/calibration.hpp"
#include "claims/inputs.hpp"
#include "claims/kind.hpp"
#include "claims_commands.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "folder.hpp"
#include "session.hpp"
#include "streams.hpp"
#include "studies/cost_estimate.hpp"

namespace epicyclic::app {

void require_models(const claims::ClaimsOptions& options, const claims::SweepModels& models) {
  for (const claims::ClaimSweep& sweep : options.sweeps)
    for (const double value : {sweep.axis.from, sweep.axis.to}) (void)models(sweep, value);
}

void require_models(const input::LoadedInput& input) {
  const claims::ClaimsOptions& options = claims::claims_in(input.study);
  for (const claims::ClaimStage& stage : options.stages) (void)claims::modes_of(input, stage);
  if (!options.sweeps.empty()) require_models(options, claims::claim_models(input));
}

namespace {

/// The middle of all ranges, with the option that a parameter counts with.
std::vector<double> middle_for(const claims::ParameterSpace& space, const claims::FreeParameter& p) {
  std::vector<double> u(space.dimension(), 0.5);
  for (std::size_t c = 0; c < space.choices.size(); ++c)
    for (std::size_t option = 0; option < space.choices[c].options.size(); ++option)
      if (space.choices[c].name == p.choice && space.choices[c].options[option].name == p.option)
        u[space.parameters.size() + c] = space.choices[c].place_of(option);
  return u;
}

/// Do both candidates move alike at both ends of each sweep?
bool move_alike(const claims::ClaimsOptions& options, const claims::CandidateModels& models,
                const std::vector<double>& a, const std::vector<double>& b) {
  const claims::SweepModels of_a = models(a);
  const claims::SweepModels of_b = models(b);
  return std::ranges::all_of(options.sweeps, [&](const claims::ClaimSweep& sweep) {
    return studies::same_equations(of_a(sweep, sweep.axis.from), of_b(sweep, sweep.axis.from)) &&
           studies::same_equations(of_a(sweep, sweep.axis.to), of_b(sweep, sweep.axis.to));
  });
}

/// Requests models at both ends of each parameter's range, with all other parameters in the middle of theirs, and with
/// each option of each choice. Warns of every parameter and option that changes nothing. The sweeps cannot determine
/// such a parameter, so that its row in a table would be chance.
/// @throws InputError that names the parameter
void examine_candidates(const claims::ClaimsOptions& options, const claims::CandidateModels& models) {
  const claims::ParameterSpace& space = options.space;
  const std::vector<double> middle(space.dimension(), 0.5);
  const auto require = [&](const std::vector<double>& u, const std::string& what) {
    try {
      const claims::ClaimSweep& sweep = options.sweeps.front();
      (void)models(u)(sweep, sweep.axis.from);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", what, error.what()));
    }
  };
  struct Variable {
    std::string place, name;
    std::vector<std::vector<double>> candidates;  // that differ by it alone
  };
  std::vector<Variable> variables;
  for (std::size_t k = 0; k < space.choices.size(); ++k) {
    Variable& choice = variables.emplace_back(Variable{fmt::format("/study/choices/{}", k), space.choices[k].name, {}});
    for (std::size_t option = 0; option < space.choices[k].options.size(); ++option) {
      std::vector<double> u = middle;
      u[space.parameters.size() + k] = space.choices[k].place_of(option);
      require(u, fmt::format("{}: with \"{}\"", choice.place, space.choices[k].options[option].name));
      choice.candidates.push_back(std::move(u));
    }
  }
  for (std::size_t k = 0; k < space.parameters.size(); ++k) {
    const claims::FreeParameter& p = space.parameters[k];
    Variable& parameter = variables.emplace_back(Variable{fmt::format("/study/parameters/{}", k), p.name, {}});
    for (const double end : {0.0, 1.0}) {
      std::vector<double> u = middle_for(space, p);
      u[k] = end;
      require(u, fmt::format("{}: with {} = {}", parameter.place, p.name, short_text(p.at(end), 6)));
      parameter.candidates.push_back(std::move(u));
    }
  }
  require_models(options, models(middle));

  for (const Variable& v : variables)
    if (std::all_of(v.candidates.begin() + 1, v.candidates.end(),
                    [&](const auto& u) { return move_alike(options, models, v.candidates.front(), u); }))
      print_message("warning: {}: {} changes nothing on any sweep, all others in the middle of their ranges\n", v.place,
                    v.name);
}

}  // namespace

void add_claims_kind() {
  static const input::StudyKind kind = [] {
    input::StudyKind with_cost = claims::claims_kind();
    with_cost.cost = [](const input::LoadedInput& input) {
      const claims::ClaimsOptions& options = claims::claims_in(input.study);
      require_models(input);
      if (options.space.dimension() > 0) examine_candidates(options, claims::candidate_models(input));
      if (options.stages.empty())
        return fmt::format("{} claims on {} sweeps; a search tries up to {} candidates", options.claims.size(),
                           options.sweeps.size(), claims::most_evaluations(options));
      return fmt::format("{} claims on {} sweeps and the natural frequencies of {} stages", options.claims.size(),
                         options.sweeps.size(), options.stages.size());
    };
    return with_cost;
  }();
  input::add_kind(kind);
}

input::LoadedInput load_open_claims(const Arguments& arguments) {
  input::LoadedInput input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
  require_kind(input, arguments, "claims");
  const auto& options = claims::claims_in(input.study);
  if (options.space.dimension() == 0)
    throw InputError("/study/parameters: is empty; there is nothing to search for or to draw");
  examine_candidates(options, claims::candidate_models(input));
  print_warnings(input);
  return input;
}

MakeEvaluator evaluator_by(claims::Glance (*glance)(const claims::ClaimsOptions&)) {
  return [glance](const input::LoadedInput& input, const std::atomic<bool>& stop) {
    const auto& options = claims::claims_in(input.study);
    return claims::evaluator_of(options, glance(options), input.study.integrator, claims::candidate_models(input),
                                &stop);
  };
}

}  // namespace epicyclic::app
