#include "folder.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "core/version.hpp"
#include "input/aliases.hpp"
#include "input/json_source.hpp"
#include "input/stage_completion.hpp"
#include "input/study_kind.hpp"
#include "store/identity.hpp"
#include "store/point_record.hpp"
#include "store/versions.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

/// Of a complete study, from its run.json: failed points, say.
std::int64_t counted(const store::OutputFolder& folder, const char* what) {
  const nlohmann::json& run = folder.previous_run();
  const auto counts = run.find("counts");
  if (counts == run.end() || !counts->is_object() || !counts->contains(what)) return 0;
  const nlohmann::json& number = (*counts)[what];
  return number.is_number_integer() ? number.get<std::int64_t>() : 0;
}

void print_differences(const store::OutputFolder& folder, const input::LoadedInput& input) {
  constexpr std::size_t most = 5;
  input::JsonSource other = input::read_json_file(folder.file("input.resolved.json"));
  // That the study is another one is known from run.json.
  if (!other.complete || !other.value.is_object()) return;
  input::use_new_names(other.value);
  const nlohmann::json computed = input::computed_values(other.value);
  const std::vector<std::string> lines = store::differences({other.value, computed}, {input.resolved, input.computed});
  if (lines.empty())
    print_message("  the inputs are the same; the command or the version of its numerics is another one\n");
  for (std::size_t k = 0; k < std::min(lines.size(), most); ++k) print_message("  {}\n", lines[k]);
  if (lines.size() > most) print_message("  and {} more\n", lines.size() - most);
}

void print_changes(const store::OutputFolder& folder) {
  constexpr std::size_t most = 10;
  const std::vector<store::ChangedFile>& changed = folder.changed();
  print_message("{}: this study is complete, but {}; all files are written again\n", folder.path().string(),
                changed.empty() ? "its run.json does not list its files" : "some of its files were changed");
  for (std::size_t k = 0; k < std::min(changed.size(), most); ++k) {
    const store::ChangedFile& file = changed[k];
    if (!file.bytes)
      print_message("  {}: {}\n", file.name, file.expected ? "missing" : "was not drawn");
    else if (*file.bytes < file.expected->bytes)
      print_message("  {}: {} bytes, not {}; kept as {}.changed if they are not its first ones\n", file.name,
                    *file.bytes, file.expected->bytes, file.name);
    else
      print_message("  {}: changed since; kept as {}.changed\n", file.name, file.name);
  }
  if (changed.size() > most) print_message("  and {} more\n", changed.size() - most);
}

}  // namespace

void report_cut_tail(const std::filesystem::path& journal, std::size_t bytes) {
  if (bytes > 0)
    print_message("{}: removed the last {} bytes, an incomplete record; its point is computed again\n",
                  journal.string(), bytes);
}

std::map<std::size_t, studies::PointResult> known_points(const store::Journal& journal,
                                                         std::span<const store::JournalEntry> entries,
                                                         const studies::SweepPlan& plan) {
  std::map<std::size_t, studies::PointResult> known;
  for (const store::JournalEntry& entry : entries) {
    studies::PointResult result = store::decode_point(journal.read(entry));
    if (result.point.index >= plan.points.size() || result.point.index != entry.point)
      throw store::DamagedData("the journal holds point " + std::to_string(entry.point) +
                               ", which the study does not have");
    known.insert_or_assign(result.point.index, std::move(result));
  }
  return known;
}

void require_kind(const input::LoadedInput& input, const Arguments& arguments, std::string_view kind) {
  const std::string file = arguments.input.empty() ? std::string("the study") : arguments.input.string();
  const std::string name(kind);
  if (!input.study.has_dynamics())
    throw InputError(file + ": is a stage without a study; " + name + " needs a file such as {\"stage\": \"" +
                     arguments.input.filename().string() + "\", \"study\": {\"kind\": \"" + name +
                     "\", ...}}; `epicyclic keys study` lists its keys");
  if (const std::string own(input.study.kind()); own != kind) {
    const std::string_view commands = input.study.plan.kind()->commands;
    throw InputError(file + ": is a study of kind " + own + "; run " +
                     (commands.empty() ? "`epicyclic " + own + "`" : std::string(commands)));
  }
}

std::int64_t report_undrawn(const std::vector<reports::DrawnFigure>& figures) {
  std::int64_t count = 0;
  for (const reports::DrawnFigure& figure : figures) {
    if (figure.outcome.drawn()) continue;
    print_message("{} was not drawn: {}\n", figure.file.string(), figure.outcome.message);
    if (figure.outcome.failed()) ++count;
  }
  return count;
}

store::Provenance provenance(int threads, const input::LoadedInput& input) {
  store::Provenance p = store::begin_provenance();
  p.library_version = EPICYCLIC_VERSION;
  p.commit = EPICYCLIC_COMMIT;
  p.dependencies = store::dependency_versions();
  p.simd_level = store::simd_level();
  p.threads = threads;
  p.input_files["input.json"] = input.study_file.name;
  if (input.stage_file) p.input_files["input.stage.json"] = input.stage_file->name;
  return p;
}

std::optional<int> refuse_or_finish(const store::OutputFolder& folder, const input::LoadedInput& input, bool quiet) {
  const std::string where = folder.path().string();
  switch (folder.outcome()) {
    case store::FolderOutcome::complete:
      if (!quiet) print_message("{}: this study is complete already; nothing to compute\n", where);
      for (const char* const count : {"failed", "undrawn", "differences", "unexplained"})
        if (counted(folder, count) > 0) return done_with_failures;
      return done;
    case store::FolderOutcome::damaged:
      print_changes(folder);
      return std::nullopt;
    case store::FolderOutcome::other_study:
      print_message("{}: contains another study; choose another folder for -o\n", where);
      print_differences(folder, input);
      return other_study;
    case store::FolderOutcome::foreign:
      print_message("{}: contains files that are not those of a study; choose an empty or new folder for -o\n", where);
      return other_study;
    case store::FolderOutcome::in_use:
      print_message("{}: is in use by another process\n", where);
      return folder_in_use;
    case store::FolderOutcome::in_parts:
      print_message("{}: parts of a study are computed in it; repeat the command when they have ended\n", where);
      return folder_in_use;
    case store::FolderOutcome::fresh:
    case store::FolderOutcome::resumable:
      return std::nullopt;
  }
  return bug;
}

std::optional<int> enter_shared(store::OutputFolder& folder, const input::LoadedInput& input, bool quiet) {
  if (const auto code = refuse_or_finish(folder, input, quiet)) return code;
  if (!folder.is_first()) return std::nullopt;
  (void)write_inputs(folder, input);
  if (folder.share()) return std::nullopt;
  print_message("{}: is in use by another process\n", folder.path().string());
  return folder_in_use;
}

void print_part(const Arguments& arguments, const std::string& folder, bool already, const std::string& words,
                nlohmann::json facts) {
  const auto& [number, of] = arguments.part;
  if (!arguments.json) {
    print("{}: part {}/{} is complete{}: {}\n", folder, number, of, already ? " already" : "", words);
    return;
  }
  facts.update({{"folder", folder}, {"part", number}, {"of", of}});
  print("{}\n", facts.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void report_parts(const std::string& folder, const PartsOfFolder& parts, std::size_t there, std::size_t all,
                  std::string_view noun) {
  if (parts.present.empty()) return;
  print_message("{}: {} of {} {} were computed by parts\n", folder, parts.computed, all, noun);
  if (there == all) return;
  std::set<std::size_t> numbers_of_parts;
  for (const store::Part& part : parts.present) numbers_of_parts.insert(part.of);
  for (const std::size_t of : numbers_of_parts) {
    std::vector<std::string> absent;
    for (store::Part part{1, of}; part.number <= of; ++part.number)
      if (store::first_of(part, parts.before) < parts.shares && !parts.present.contains(part))
        absent.push_back(fmt::format("{}/{}", part.number, of));
    if (!absent.empty())
      print_message("{}: no journal of part {}; the missing {} are computed now\n", folder, fmt::join(absent, ", "),
                    noun);
  }
}

std::string resolved_text(const input::LoadedInput& input) { return input.resolved.dump(2) + "\n"; }

std::string write_inputs(const store::OutputFolder& folder, const input::LoadedInput& input) {
  std::string resolved = resolved_text(input);
  write_file_atomically(folder.file("input.json"), input.study_file.bytes);
  // The program chooses these names: a copy under the user's name could replace another file here. run.json has the
  // user's names.
  if (input.stage_file) write_file_atomically(folder.file("input.stage.json"), input.stage_file->bytes);
  write_file_atomically(folder.file("input.resolved.json"), resolved);
  return resolved;
}

}  // namespace epicyclic::app
