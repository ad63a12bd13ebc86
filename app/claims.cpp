#include "claims.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "folder.hpp"
#include "input/study_model.hpp"
#include "session.hpp"
#include "streams.hpp"
#include "studies/probes.hpp"

namespace epicyclic::app {

void require_models(const studies::ClaimsOptions& options, const studies::SweepModels& models) {
  for (const studies::ClaimSweep& sweep : options.sweeps)
    for (const double value : {sweep.axis.from, sweep.axis.to}) (void)models(sweep, value);
}

namespace {

/// The middle of all ranges, with the option that a parameter counts with.
std::vector<double> middle_for(const studies::ParameterSpace& space, const studies::FreeParameter& p) {
  std::vector<double> u(space.dimension(), 0.5);
  for (std::size_t c = 0; c < space.choices.size(); ++c)
    for (std::size_t option = 0; option < space.choices[c].options.size(); ++option)
      if (space.choices[c].name == p.choice && space.choices[c].options[option].name == p.option)
        u[space.parameters.size() + c] = space.choices[c].place_of(option);
  return u;
}

/// Do both candidates move alike at both ends of each sweep?
bool move_alike(const studies::ClaimsOptions& options, const studies::CandidateModels& models,
                const std::vector<double>& a, const std::vector<double>& b) {
  const studies::SweepModels of_a = models(a);
  const studies::SweepModels of_b = models(b);
  return std::ranges::all_of(options.sweeps, [&](const studies::ClaimSweep& sweep) {
    return studies::same_motion(of_a(sweep, sweep.axis.from), of_b(sweep, sweep.axis.from)) &&
           studies::same_motion(of_a(sweep, sweep.axis.to), of_b(sweep, sweep.axis.to));
  });
}

/// Parameters and choices that change nothing on any sweep. A line for each.
std::vector<std::string> idle_variables(const studies::ClaimsOptions& options, const studies::CandidateModels& models) {
  const studies::ParameterSpace& space = options.space;
  std::vector<std::string> lines;
  constexpr const char* words = "{}: {} changes nothing on any sweep, all others in the middle of their ranges";
  for (std::size_t k = 0; k < space.parameters.size(); ++k) {
    std::vector<double> low = middle_for(space, space.parameters[k]);
    std::vector<double> high = low;
    low[k] = 0.0;
    high[k] = 1.0;
    if (move_alike(options, models, low, high))
      lines.push_back(fmt::format(words, fmt::format("/study/parameters/{}", k), space.parameters[k].name));
  }
  for (std::size_t c = 0; c < space.choices.size(); ++c) {
    const studies::Choice& choice = space.choices[c];
    std::vector<double> first(space.dimension(), 0.5);
    first[space.parameters.size() + c] = choice.place_of(0);
    std::vector<double> other = first;
    bool alike = true;
    for (std::size_t option = 1; option < choice.options.size() && alike; ++option) {
      other[space.parameters.size() + c] = choice.place_of(option);
      alike = move_alike(options, models, first, other);
    }
    if (alike) lines.push_back(fmt::format(words, fmt::format("/study/choices/{}", c), choice.name));
  }
  return lines;
}

}  // namespace

void examine_candidates(const studies::ClaimsOptions& options, const studies::CandidateModels& models) {
  const studies::ParameterSpace& space = options.space;
  const std::vector<double> middle(space.dimension(), 0.5);
  const auto require = [&](const std::vector<double>& u, const std::string& what) {
    try {
      const studies::ClaimSweep& sweep = options.sweeps.front();
      (void)models(u)(sweep, sweep.axis.from);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", what, error.what()));
    }
  };
  for (std::size_t k = 0; k < space.choices.size(); ++k)
    for (std::size_t option = 0; option < space.choices[k].options.size(); ++option) {
      std::vector<double> u = middle;
      u[space.parameters.size() + k] = space.choices[k].place_of(option);
      require(u, fmt::format("/study/choices/{}: with \"{}\"", k, space.choices[k].options[option].name));
    }
  for (std::size_t k = 0; k < space.parameters.size(); ++k) {
    const studies::FreeParameter& p = space.parameters[k];
    std::vector<double> u = middle_for(space, p);
    for (const double end : {0.0, 1.0}) {
      u[k] = end;
      require(u, fmt::format("/study/parameters/{}: with {} = {}", k, p.name, short_text(p.at(end), 6)));
    }
  }
  require_models(options, models(middle));
  for (const std::string& line : idle_variables(options, models)) tell("warning: {}\n", line);
}

input::LoadedInput load_open_claims(const Arguments& arguments) {
  const std::vector<input::Assignment> sets = input::parse_assignments(arguments.sets);
  input::LoadedInput input = input::load_input(arguments.input, sets);
  require_kind(input, arguments, "claims");
  const auto& options = std::get<studies::ClaimsOptions>(input.study.plan);
  if (options.space.dimension() == 0)
    throw InputError("/study/parameters: is empty; there is nothing to search for or to draw");
  examine_candidates(options, input::candidate_models(arguments.input, sets, options));
  tell_warnings(input);
  return input;
}

MakeEvaluator evaluator_by(studies::Glance (*glance)(const studies::ClaimsOptions&)) {
  return [glance](const input::LoadedInput& input, const Arguments& arguments, const std::atomic<bool>& stop) {
    const auto& options = std::get<studies::ClaimsOptions>(input.study.plan);
    const std::vector<input::Assignment> sets = input::parse_assignments(arguments.sets);
    return studies::evaluator_of(options, glance(options), input.study.integrator,
                                 input::candidate_models(arguments.input, sets, options), &stop);
  };
}

}  // namespace epicyclic::app
