#include "session.hpp"

#include <utility>

#include "figures/gnuplot.hpp"
#include "folder.hpp"
#include "host.hpp"
#include "input/study_model.hpp"
#include "store/identity.hpp"
#include "streams.hpp"

namespace epicyclic::app {

std::string identity_of(const input::LoadedInput& input, std::string_view command, std::optional<int> judging) {
  return store::identity({input.resolved, input.computed}, command, judging);
}

void print_warnings(const input::LoadedInput& input) {
  const Host* to = host();
  for (const std::string& warning : input::warnings(input)) {
    if (to != nullptr && to->warning)
      to->warning(warning);
    else
      print_message("{}\n", warning);
  }
}

Session::Session(const Arguments& arguments, const input::LoadedInput& input, std::string identity, int threads,
                 int ranks, bool again)
    : identity_(std::move(identity)),
      folder_(arguments.output, identity_, figures::gnuplot_is_installed()),
      exit_code_(again && folder_.outcome() == store::FolderOutcome::complete
                     ? std::nullopt
                     : refuse_or_finish(folder_, input, arguments.quiet)) {
  if (exit_code_) return;
  facts_ = provenance(threads, input);
  facts_.ranks = ranks;
  resolved_ = write_inputs(folder_, input);
  folder_.write_run(store::RunState::running, store::run_facts(facts_));
  watch_ = std::make_unique<FolderWatch>(folder_);
}

void Session::end(store::RunState state, std::map<std::string, std::int64_t> counts, std::optional<double> occupancy) {
  facts_.ended = store::utc_now();
  facts_.counts = std::move(counts);
  facts_.occupancy = occupancy;
  folder_.write_run(state, store::run_facts(facts_));
}

}  // namespace epicyclic::app
