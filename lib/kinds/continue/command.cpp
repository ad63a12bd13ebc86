// epicyclic continue: branches of periodic orbits along one parameter, and their special points.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "finished_study.hpp"
#include "folder.hpp"
#include "input/study_model.hpp"
#include "kind_commands.hpp"
#include "kinds/continue/output.hpp"
#include "kinds/continue/proof_output.hpp"
#include "progress.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "store/branch_record.hpp"
#include "store/identity.hpp"
#include "store/journal.hpp"
#include "streams.hpp"
#include "studies/branch_proof.hpp"
#include "studies/branches.hpp"
#include "studies/cost_estimate.hpp"

namespace epicyclic::app {

namespace {

using studies::BranchesOptions;
using studies::TracedBranches;

/// The models of the family, until a stop is requested.
studies::ModelAt stoppable(studies::ModelAt models) {
  return [models = std::move(models)](double value) {
    give_up_if_stopped();
    return models(value);
  };
}

/// Orbits to start from: those reached from the default start, then seeds. Orbits that were not found are returned
/// apart.
std::vector<studies::BranchAttempt> add_starts(const studies::BranchSystem& system, const BranchesOptions& options,
                                               const studies::ModelAt& models, analysis::BifurcationDiagram& tree) {
  std::vector<studies::BranchAttempt> attempts;
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  Progress progress("continue: starts", options.all_starts().size() + options.seeds.size());
  const auto add = [&](double value, int period, bool seed, double reach, studies::BranchOrigin origin) {
    const bool found = origin.orbit.has_value();
    if (found)
      tree.start(*std::move(origin.orbit), origin.keeps_symmetry, origin.period, origin.shooting_intervals, reach);
    attempts.push_back({value, period, seed, found, origin.distance, std::move(origin.message)});
    progress.update(attempts.size(), 0);
  };
  for (const double value : options.all_starts())
    add(value, options.period, false, anywhere,
        steady_state_start(system, models(value), value, options.transient_periods));
  for (const studies::BranchSeed& seed : options.seeds)
    add(seed.value, seed.period, true, seed.max_distance.value_or(anywhere), seed_start(system, seed));
  return attempts;
}

/// A journal in the folder, with its records in order. A torn end that is removed is reported.
class OrderedJournal {
 public:
  /// @param what  name of a record in messages
  OrderedJournal(Session& session, const char* name, std::string what)
      : what_(std::move(what)), journal_(session.folder().file(name), session.identity()) {
    report_cut_tail(session.folder().file(name), journal_.cut_bytes());
  }

  /// Gives each record that is there to `take`.
  /// @throws DamagedData when one is missing, or there are more than `most`
  template <class Take>
  void read(std::size_t most, Take take) {
    for (const store::JournalEntry& entry : journal_.entries()) {
      if (entry.point != count_ || count_ >= most)
        throw store::DamagedData(fmt::format("the journal holds {} {} where {} is due", what_, entry.point, count_));
      take(journal_.read(entry));
      ++count_;
    }
  }

  void append(const std::vector<std::byte>& record) { journal_.append(count_++, record); }
  [[nodiscard]] std::size_t count() const { return count_; }
  void close() { journal_.close(); }

 private:
  std::string what_;
  store::Journal journal_;
  std::size_t count_ = 0;
};

/// The models over two parameters, until a stop is requested.
studies::ModelOverPlane stoppable_plane(const input::LoadedInput& input, const BranchesOptions& options,
                                        const std::string& second) {
  return [plane = input::model_plane(input, options.parameter, second, family_step(options))](double x, double y) {
    give_up_if_stopped();
    return plane(x, y);
  };
}

constexpr std::size_t any_number = static_cast<std::size_t>(-1);

/// Results of the search at each of its values, kept in a journal of their own; each is a start.
std::vector<studies::CoexistingOrbits> add_found(Session& session, const studies::BranchSystem& system,
                                                 const BranchesOptions& options, const studies::ModelAt& models,
                                                 analysis::BifurcationDiagram& tree) {
  const studies::BranchSearchOptions& wanted = options.search.value();
  OrderedJournal journal(session, "journal.search.bin", "search");
  std::vector<studies::CoexistingOrbits> all;
  journal.read(wanted.values.size(), [&](const auto& record) { all.push_back(store::decode_found(record)); });
  Progress progress("continue: search", wanted.values.size(), all.size());
  while (all.size() < wanted.values.size()) {
    const double value = wanted.values[all.size()];
    studies::CoexistingOrbits found =
        search_coexisting_orbits(system, models(value), value, wanted, options.transient_periods);
    journal.append(store::encode_found(found));
    all.push_back(std::move(found));
    progress.update(all.size(), 0);
  }
  journal.close();
  for (const studies::CoexistingOrbits& found : all)
    for (const studies::CoexistingOrbit& m : found.orbits)
      tree.start(m.orbit, m.keeps_symmetry, m.period, m.shooting_intervals);
  return all;
}

/// Rows of orbits, each computed once: those of partial tables are those of the last ones.
class OrbitRows {
 public:
  OrbitRows(const studies::ModelAt& models, int phases) : models_(models), phases_(phases) {}

  const studies::BranchRow& of(const analysis::Branch& branch, const analysis::BranchOrbit& orbit) {
    std::vector<double> key = {static_cast<double>(branch.family.period), orbit.at.value};
    key.insert(key.end(), orbit.at.states.reshaped().begin(), orbit.at.states.reshaped().end());
    auto known = rows_.find(key);
    if (known == rows_.end())
      known = rows_.emplace(std::move(key), studies::branch_row(branch.family, orbit, models_(orbit.at.value), phases_))
                  .first;
    return known->second;
  }

  /// omega_m [rad/s] and the speeds of the members.
  const std::pair<double, gear::Speeds>& speeds_at(double value) {
    auto known = speeds_.find(value);
    if (known == speeds_.end()) {
      const model::DynamicModel model = models_(value);
      known = speeds_.emplace(value, std::pair(model.omega * model.scales.omega_sn, model.speeds)).first;
    }
    return known->second;
  }

 private:
  const studies::ModelAt& models_;
  int phases_;
  std::map<std::vector<double>, studies::BranchRow> rows_;
  std::map<double, std::pair<double, gear::Speeds>> speeds_;
};

/// Rows of all orbits and special points of the branches.
/// @param finished  called for each of them
void add_rows(TracedBranches& traced, OrbitRows& known, const model::DynamicModel& first,
              const std::function<void()>& finished) {
  traced.special = studies::special_rows(traced.branches, contact_surfaces(first));
  const auto row = [&](const analysis::Branch& branch, const analysis::BranchOrbit& orbit) {
    finished();
    return known.of(branch, orbit);
  };
  for (const analysis::Branch& branch : traced.branches) {
    std::vector<studies::BranchRow>& rows = traced.rows.emplace_back();
    for (const analysis::BranchOrbit& orbit : branch.orbits) rows.push_back(row(branch, orbit));
    decide_stability(branch, rows);
  }
  for (studies::SpecialRow& r : traced.special) {
    const analysis::Branch& branch = traced.branches[r.branch];
    traced.at_special.push_back(row(branch, branch.special[r.point].orbit));
    // At the value itself, which is located more closely than the orbit that was found next to it.
    std::tie(r.mesh_frequency, r.speeds) =
        known.speeds_at(std::isfinite(r.value) ? r.value : traced.at_special.back().value);
  }
}

/// Writes the tables of the present results from time to time: branches may take hours.
class PartialTables {
 public:
  PartialTables(const store::OutputFolder& folder, const kinds::ContinueOutput& output, OrbitRows& rows,
                const model::DynamicModel& first)
      : folder_(folder), output_(output), rows_(rows), first_(first) {}

  void see(const analysis::BifurcationDiagram& tree) {
    const Clock::time_point begun = Clock::now();
    if (begun < due_) return;
    TracedBranches traced;
    traced.branches = tree.branches();
    if (auto branch = tree.unfinished_branch()) {
      branch->last.message = "is still being continued";
      traced.branches.push_back(*std::move(branch));
    }
    if (!traced.branches.empty()) {
      add_rows(traced, rows_, first_, give_up_if_stopped);
      folder_.require_there();
      kinds::write_branch_tables(folder_.path(), output_, traced);
    }
    // A small part of the time, however many orbits there are.
    constexpr int part = 20;
    due_ = Clock::now() + std::max<Clock::duration>(interval, part * (Clock::now() - begun));
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds interval{10};
  const store::OutputFolder& folder_;
  const kinds::ContinueOutput& output_;
  OrbitRows& rows_;
  const model::DynamicModel& first_;
  Clock::time_point due_ = Clock::now() + interval / 2;
};

/// Estimates the time that branches take, by the part of the range that the present branch has covered, and its time.
class Pace {
 public:
  explicit Pace(const BranchesOptions& options) : range_(options.to - options.from) {}

  /// @param computed  in this session
  void see(const analysis::TreeStep& step, bool computed) {
    using Kind = analysis::TreeStep::Kind;
    if (step.kind == Kind::begun) {
      if (computed) end_branch();
      low_ = std::numeric_limits<double>::infinity();
      high_ = -low_;
      begun_ = Clock::now();
      known_ = 0.0;
    }
    if (step.orbit) {
      low_ = std::min(low_, step.orbit->at.value);
      high_ = std::max(high_, step.orbit->at.value);
    }
    if (!computed) {
      begun_ = Clock::now();
      known_ = covered();
    }
  }

  /// In words; empty while nothing is known.
  [[nodiscard]] std::string left(std::size_t waiting) const {
    constexpr double enough = 0.01;  // of the range
    const double spent = seconds();
    const double new_part = covered() - known_;
    if (!(new_part > enough) && branches_ == 0) return {};
    const double whole = branches_ > 0 ? branch_seconds_ / branches_ : spent / new_part;
    const double here = new_part > enough ? spent / new_part * (1.0 - covered()) : std::max(0.0, whole - spent);
    return fmt::format("about {} left if no more branches are found",
                       duration_text(here + whole * static_cast<double>(waiting)));
  }

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }
  /// Part of the range. A branch covers a part again after a fold.
  [[nodiscard]] double covered() const { return high_ > low_ ? std::min(1.0, (high_ - low_) / range_) : 0.0; }
  void end_branch() {
    if (!(high_ >= low_)) return;  // there was none
    branch_seconds_ += seconds();
    ++branches_;
  }

  double range_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  double known_ = 0;  ///< part that earlier sessions covered
  Clock::time_point begun_ = Clock::now();
  double branch_seconds_ = 0;
  int branches_ = 0;
};

/// The tree to its end, each step kept in the journal.
/// @param axis   the parameter in words
/// @param first  the model at the start of the branches
void grow(Session& session, const BranchesOptions& options, const reports::AxisWords& axis,
          const model::DynamicModel& first, PartialTables& tables, analysis::BifurcationDiagram& tree) {
  const auto place = [&](double value) {
    std::string words = fmt::format(" at {} = {}", axis.name, axis.text(value, 6));
    if (axis.name == studies::speed_parameter)
      words += fmt::format(" ({} {} rpm)", first.has_ring() ? "sun" : "gear 1",
                           short_text(gear::rpm * first.speeds.sun / first.omega * value, 5));
    return words;
  };
  OrderedJournal journal(session, "journal.bin", "step");
  Pace pace(options);
  journal.read(any_number, [&](const auto& record) {
    analysis::TreeStep step = store::decode_step(record);
    pace.see(step, /*computed=*/false);
    tree.apply(std::move(step));
  });
  Progress progress("continue: orbits", unknown_total, journal.count());
  while (const auto step = tree.advance()) {
    journal.append(store::encode_step(*step));
    pace.see(*step, /*computed=*/true);
    std::string words = fmt::format("branch {}", tree.branches().size());
    if (step->orbit) words += place(step->orbit->at.value);
    if (tree.waiting() > 0) words += fmt::format(", {} waiting", tree.waiting());
    if (const std::string left = pace.left(tree.waiting()); !left.empty()) words += "; " + left;
    progress.update(journal.count(), std::move(words));
    give_up_if_stopped();
    tables.see(tree);
  }
  journal.close();
  progress.finish();
}

/// Rows of all orbits and special points.
void compute_rows(TracedBranches& traced, OrbitRows& rows, const studies::ModelAt& models) {
  std::size_t total = 0;
  for (const analysis::Branch& branch : traced.branches) total += branch.orbits.size() + branch.special.size();
  Progress progress("continue: rows", total);
  std::size_t finished = 0;
  add_rows(traced, rows, models(traced.branches.front().orbits.front().at.value), [&] {
    give_up_if_stopped();
    progress.update(++finished, 0);
  });
}

void add_note(studies::SpecialRow& row, const std::string& note) {
  if (!row.note.empty()) row.note.append("; ");
  row.note.append(note);
}

/// For a study with a smooth clearance: the special points with the exact clearance, each kept in a journal.
void compute_exact_values(Session& session, const input::LoadedInput& input, const BranchesOptions& options,
                          TracedBranches& traced) {
  const double width = input.study.model.clearance_smoothing;
  const studies::ModelOverPlane models = stoppable_plane(input, options, "/integrator/clearance_smoothing");
  OrderedJournal journal(session, "journal.exact.bin", "exact value");
  journal.read(traced.special.size(), [&](const auto& record) {
    studies::SpecialRow& row = traced.special[journal.count()];
    row.exact = store::decode_exact(record, row.note);
  });
  Progress progress("continue: exact clearance", traced.special.size(), journal.count());
  while (journal.count() < traced.special.size()) {
    studies::SpecialRow& row = traced.special[journal.count()];
    std::string why_not;
    row.exact = exact_value(models, traced, row, width, options, why_not);
    if (!row.exact) add_note(row, why_not);
    journal.append(store::encode_exact(row.exact, row.note));
    progress.update(journal.count(), 0);
  }
  journal.close();
}

/// The requested loci. Each is kept in a journal of its own when it is complete.
std::vector<studies::TracedLocus> trace_loci(Session& session, const input::LoadedInput& input,
                                             const BranchesOptions& options, const TracedBranches& traced) {
  const studies::LociOptions& wanted = options.loci.value();
  const studies::ModelOverPlane models = stoppable_plane(input, options, wanted.parameter);
  const double second = input::given_value(input, wanted.parameter);
  OrderedJournal journal(session, "journal.loci.bin", "locus");
  std::vector<studies::TracedLocus> loci;
  journal.read(any_number, [&](const auto& record) { loci.push_back(store::decode_locus(record)); });
  const std::vector<std::size_t> points = studies::points_of_loci(traced, wanted);
  Progress progress("continue: loci", points.size());
  std::vector<studies::TracedLocus> all;  // those of the journal are met again in order
  for (std::size_t k = 0; k < points.size(); ++k) {
    const studies::SpecialRow& point = traced.special[points[k]];
    progress.update(k, fmt::format("from {} at {}", kind_word(point), short_text(point.value, 6)));
    if (is_on_a_locus(all, traced, point, second, options)) continue;
    if (all.size() < loci.size()) {
      all.push_back(loci[all.size()]);
      continue;
    }
    all.push_back(trace_locus(models, traced, point, second, options));
    journal.append(store::encode_locus(all.back()));
  }
  progress.update(points.size(), 0);
  journal.close();
  return all;
}

/// Loci begin at the study's own value of the second parameter.
void require_given_within(const input::LoadedInput& input, const studies::LociOptions& loci) {
  const double given = input::given_value(input, loci.parameter);
  if (!(given >= loci.from && given <= loci.to))
    throw InputError(fmt::format("/study/loci: {} is {} in this study, must be within from = {} and to = {}",
                                 loci.parameter, given, loci.from, loci.to));
}

/// Number of requested results that were not reached.
std::size_t count_failures(const TracedBranches& traced, const std::vector<studies::TracedLocus>& loci) {
  std::size_t failed = traced.broken_off() + (traced.branches.empty() ? 1 : 0);
  for (const studies::BranchAttempt& a : traced.attempts) failed += a.seed && !a.found ? 1 : 0;
  for (const studies::SpecialRow& r : traced.special) failed += r.kind == analysis::SpecialKind::unresolved ? 1 : 0;
  for (const studies::TracedLocus& locus : loci) failed += locus.message.empty() ? 0 : 1;
  return failed;
}

/// A sweep that the branches are to prove.
/// @throws InputError for one along another parameter, beside the branches' range, or of other equations
FinishedStudy sweep_to_prove(const Arguments& arguments, const input::LoadedInput& input,
                             const BranchesOptions& options, const studies::ModelAt& models) {
  FinishedStudy sweep(arguments.against);
  const std::string folder = arguments.against.string();
  const auto* plan = sweep.input().study.plan.get_if<studies::SweepOptions>();
  if (plan == nullptr)
    throw InputError(folder + ": --against takes a sweep, this is a " + std::string(sweep.input().study.kind()));
  if (plan->axis.name != options.parameter)
    throw InputError(
        fmt::format("{}: is a sweep along {}, the branches are along {}", folder, plan->axis.name, options.parameter));
  const double last = axis_value(plan->axis, static_cast<std::size_t>(plan->axis.points) - 1);
  if (plan->axis.from < options.from || last > options.to) {
    constexpr int digits = 9;
    const reports::AxisWords words = reports::axis_words(options.parameter, input.study.axis_speed);
    const auto text = [&](double value) { return words.text(value, digits); };
    throw InputError(fmt::format("{}: {} is from {} to {}, of the branches only from {} to {}", folder, words.name,
                                 text(plan->axis.from), text(last), text(options.from), text(options.to)));
  }
  for (const std::size_t point : {std::size_t{0}, sweep.points().count - 1})
    if (!studies::same_equations(sweep.model_at(point), models(sweep.plan().points[point].value)))
      throw InputError(fmt::format("{}: its equations of motion are not those of {}, at {} = {}", folder,
                                   arguments.input.string(), options.parameter, sweep.plan().points[point].value));
  return sweep;
}

/// The result of the comparison with the sweep, with its files.
struct Proved {
  studies::BranchProof proof;
  std::string summary;
  std::vector<reports::DrawnFigure> figures;
};

Proved prove_sweep(const FinishedStudy& sweep, const store::OutputFolder& folder, const kinds::ContinueOutput& output,
                   const TracedBranches& traced, std::size_t dimension) {
  const studies::PointSource points = sweep.points();
  const auto& plan = sweep.input().study.plan.as<studies::SweepOptions>();
  Proved proved;
  {
    Progress progress("continue: against the sweep", points.count);
    proved.proof = prove(traced, plan, points, dimension, {}, [&](std::size_t done) {
      progress.update(done, 0);
      give_up_if_stopped();
    });
  }
  const input::Study& study = sweep.input().study;
  const kinds::ProvedSweep proved_sweep{study.name.empty() ? sweep.folder().string() : study.name, sweep.identity(),
                                        output.poincare_columns, points};
  folder.require_there();
  proved.summary = kinds::proof_summary(output, proved_sweep, traced, proved.proof);
  kinds::write_proof_csv(folder.file("proof.csv"), traced, proved.proof);
  write_file_atomically(folder.file("proof.md"), proved.summary);
  proved.figures = kinds::draw_proof_figures(folder.file("figures"), output, proved_sweep, traced);
  return proved;
}

void print_result(const Arguments& arguments, const TracedBranches& traced, const Proved& proved, std::size_t failed,
                  const std::string& summary, const std::vector<reports::DrawnFigure>& figures) {
  if (!arguments.json) {
    print("{}\n", summary);
    if (!proved.summary.empty()) print("{}\n", proved.summary);
    for (const reports::DrawnFigure& figure : figures)
      if (figure.outcome.drawn()) print("figure: {}\n", figure.file.string());
    return;
  }
  nlohmann::json summary_json = {{"folder", arguments.output.string()},
                                 {"branches", nlohmann::json::array()},
                                 {"special", nlohmann::json::array()},
                                 {"failed", failed},
                                 {"figures", nlohmann::json::array()}};
  for (const analysis::Branch& branch : traced.branches)
    summary_json["branches"].push_back({{"period", branch.family.period},
                                        {"orbits", branch.orbits.size()},
                                        {"first", branch.orbits.front().at.value},
                                        {"last", branch.orbits.back().at.value}});
  for (const studies::SpecialRow& r : traced.special) {
    nlohmann::json one = {{"branch", r.branch}, {"kind", kind_word(r)}, {"value", r.value}, {"error_bound", nullptr}};
    if (std::isfinite(r.error_bound)) one["error_bound"] = r.error_bound;
    summary_json["special"].push_back(std::move(one));
  }
  if (!proved.summary.empty())
    summary_json["proof"] = {{"periodic", proved.proof.periodic},
                             {"off_branches", proved.proof.off.size()},
                             {"changes", proved.proof.counted()},
                             {"unexplained", proved.proof.unexplained()}};
  for (const reports::DrawnFigure& figure : figures)
    if (figure.outcome.drawn()) summary_json["figures"].push_back(figure.file.string());
  print("{}\n", summary_json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void add_continue_options(CLI::App& command, Arguments& arguments) {
  command
      .add_option("--from", arguments.from,
                  "start branches from a finished study: from one point with FOLDER:INDEX, FOLDER:up=VALUE or "
                  "FOLDER:down=VALUE, from each range of one period with FOLDER; can be repeated")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  command.add_option("--against", arguments.against,
                     "explain each change of a complete sweep (its folder) by the branches");
  command
      .add_option("--unexplained", arguments.unexplained, "number of changes of that sweep that may stay unexplained")
      ->check(CLI::Range(0, 1000000))
      ->needs("--against")
      ->capture_default_str();
}

int run_continue(const Arguments& arguments) {
  std::vector<std::string> notes;
  const input::LoadedInput input =
      with_seeds(arguments.input, input::parse_assignments(arguments.sets), arguments.from, notes);
  require_kind(input, arguments, "continue");
  const auto& options = input.study.plan.as<BranchesOptions>();
  const reports::AxisWords axis = reports::axis_words(options.parameter, input.study.axis_speed);
  const studies::ModelAt models = stoppable(input::model_family(input, options.parameter, family_step(options)));
  // Options and models that do not fit show here, before anything is written.
  if (options.loci) require_given_within(input, *options.loci);
  const model::DynamicModel first_model = models(options.from);
  (void)models(options.to);
  const studies::BranchSystem system = branch_system(models, options, first_model);
  const auto sweep = arguments.against.empty()
                         ? nullptr
                         : std::make_unique<FinishedStudy>(sweep_to_prove(arguments, input, options, models));
  print_warnings(input);
  for (const std::string& note : notes) print_message("{}\n", note);

  Session session(arguments, input, identity_of(input, "continue"), 1, 1, sweep != nullptr);
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();

  const kinds::ContinueOutput output{options,
                                     studies::poincare_columns(first_model),
                                     static_cast<std::size_t>(first_model.planets),
                                     session.resolved(),
                                     reports::figure_title(input.study),
                                     input.study.axis_speed};
  TracedBranches traced;
  std::vector<studies::CoexistingOrbits> found;
  std::vector<studies::TracedLocus> loci;
  std::int64_t undrawn = 0;
  std::size_t failed = 0;
  const auto close_run = [&](store::RunState state) {
    std::size_t orbits = 0;
    for (const analysis::Branch& branch : traced.branches) orbits += branch.orbits.size();
    session.end(state, {{"branches", static_cast<std::int64_t>(traced.branches.size())},
                        {"orbits", static_cast<std::int64_t>(orbits)},
                        {"special_points", static_cast<std::int64_t>(traced.special.size())},
                        {"failed", static_cast<std::int64_t>(failed)},
                        {"undrawn", undrawn}});
  };
  try {
    analysis::BifurcationDiagram tree(system.system, system.options);
    traced.attempts = add_starts(system, options, models, tree);
    for (const studies::BranchAttempt& a : traced.attempts)
      if (const std::string words = kinds::attempt_text(axis, a); !words.empty()) print_message("{}\n", words);
    if (options.search) found = add_found(session, system, options, models, tree);
    OrbitRows rows(models, options.output_phases);
    PartialTables tables(folder, output, rows, first_model);
    grow(session, options, axis, first_model, tables, tree);
    traced.branches = tree.branches();
    traced.full = tree.full();
    if (!traced.branches.empty()) compute_rows(traced, rows, models);
    if (input.study.model.clearance_smoothing > 0.0 && options.parameter != "/integrator/clearance_smoothing")
      compute_exact_values(session, input, options, traced);
    if (options.loci) loci = trace_loci(session, input, options, traced);
  } catch (const Stopped&) {
    close_run(store::RunState::stopped);
    print_message("stopped; re-run the same command to resume\n");
    return stopped_early;
  }
  failed = count_failures(traced, loci);

  folder.require_there();
  const std::string summary = kinds::continue_summary(output, traced, loci) + kinds::found_text(output, found);
  if (options.search) kinds::write_found_csv(folder.file("orbits.csv"), found);
  kinds::write_continue_tables(folder.path(), output, traced, loci);
  write_file_atomically(folder.file("continue.md"), summary);
  auto figures = kinds::draw_continue_figures(folder.file("figures"), output, traced);
  if (options.loci) figures.push_back(kinds::draw_loci(folder.file("figures"), output, loci));
  Proved proved;
  try {
    if (sweep) proved = prove_sweep(*sweep, folder, output, traced, first_model.dimension);
  } catch (const Stopped&) {
    close_run(store::RunState::stopped);
    print_message("stopped; re-run the same command to resume\n");
    return stopped_early;
  }
  if (const std::size_t off = proved.proof.off.size(); off > 0)
    print_message("{} of the {} periodic points of the sweep lie on no branch; see proof.md\n", off,
                  proved.proof.periodic);
  std::ranges::move(proved.figures, std::back_inserter(figures));
  undrawn = report_undrawn(figures);
  close_run(store::RunState::complete);
  print_result(arguments, traced, proved, failed, summary, figures);
  const bool explained = proved.proof.unexplained() <= static_cast<std::size_t>(arguments.unexplained);
  return failed == 0 && undrawn == 0 && explained ? done : done_with_failures;
}

}  // namespace

const Command& continue_command() {
  static const Command command = {
      .name = "continue",
      .meaning = "continue branches of periodic orbits, locate their bifurcations, and check a sweep against them",
      .run = &run_continue,
      .takes = Takes::output,
      .options = &add_continue_options,
  };
  return command;
}

}  // namespace epicyclic::app
