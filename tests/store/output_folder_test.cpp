#include "store/output_folder.hpp"

#include <csignal>
#include <cstdlib>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/errors.hpp"
#include "store/digest.hpp"
#include "store/provenance.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::store::output_folder_test {
namespace {

using nlohmann::json;
using test::contents;
using test::message_of;
using test::put_file;
using test::TemporaryFolder;

const std::string identity(64, 'a');
const std::string other_identity(64, 'b');

json run_of(const std::filesystem::path& folder) { return json::parse(contents(folder / "run.json")); }

TEST(OutputFolder, NewFolderIsFreshAndBearsItsIdentityAtOnce) {
  const TemporaryFolder folder;
  const auto path = folder / "parents/too/out";
  const OutputFolder out(path, identity);
  EXPECT_EQ(out.outcome(), FolderOutcome::fresh);
  EXPECT_TRUE(out.previous_run().is_null());
  EXPECT_EQ(run_of(path)["identity"], identity);
  EXPECT_EQ(run_of(path)["state"], "running");
}

TEST(OutputFolder, StateDecidesBetweenResumableAndComplete) {
  const TemporaryFolder folder;
  EXPECT_EQ(OutputFolder(folder.path(), identity).outcome(), FolderOutcome::fresh);
  for (const RunState state : {RunState::running, RunState::stopped, RunState::failed, RunState::complete}) {
    const OutputFolder out(folder.path(), identity);
    EXPECT_EQ(out.outcome(), FolderOutcome::resumable) << to_string(state);
    out.write_run(state, json::object());
    EXPECT_EQ(run_of(folder.path())["state"], to_string(state));
  }
  EXPECT_EQ(OutputFolder(folder.path(), identity).outcome(), FolderOutcome::complete);
}

TEST(OutputFolder, ResumableFolderMayHoldFiles) {
  const TemporaryFolder folder;
  { const OutputFolder out(folder.path(), identity); }
  put_file(folder / "journal.bin", "x");
  std::filesystem::create_directory(folder / "figures");
  EXPECT_EQ(OutputFolder(folder.path(), identity).outcome(), FolderOutcome::resumable);
}

TEST(OutputFolder, OtherStudyIsTurnedAwayAndNothingTouched) {
  const TemporaryFolder folder;
  { const OutputFolder out(folder.path(), identity); }
  const std::string before = contents(folder / "run.json");
  const OutputFolder out(folder.path(), other_identity);
  EXPECT_EQ(out.outcome(), FolderOutcome::other_study);
  EXPECT_EQ(out.previous_run()["identity"], identity);
  EXPECT_THROW(out.write_run(RunState::running, json::object()), std::logic_error);
  EXPECT_EQ(contents(folder / "run.json"), before);
  // Turned away, it holds no lock.
  EXPECT_EQ(OutputFolder(folder.path(), identity).outcome(), FolderOutcome::resumable);
}

TEST(OutputFolder, SecondOpenerIsTurnedAway) {
  const TemporaryFolder folder;
  {
    const OutputFolder first(folder.path(), identity);
    const OutputFolder second(folder.path(), identity);
    EXPECT_EQ(second.outcome(), FolderOutcome::in_use);
    EXPECT_THROW(second.write_run(RunState::running, json::object()), std::logic_error);
    EXPECT_EQ(OutputFolder(folder.path(), other_identity).outcome(), FolderOutcome::in_use);
  }
  EXPECT_EQ(OutputFolder(folder.path(), identity).outcome(), FolderOutcome::resumable);
}

TEST(OutputFolder, LockOfAnotherProcessEndsWithItsDeath) {
  const TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const OutputFolder out(folder.path(), identity);
    const char byte = out.outcome() == FolderOutcome::fresh ? 'y' : 'n';
    if (::write(ready[1], &byte, 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_EQ(byte, 'y');
  EXPECT_EQ(OutputFolder(folder.path(), identity).outcome(), FolderOutcome::in_use);
  ::kill(child, SIGKILL);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  EXPECT_EQ(OutputFolder(folder.path(), identity).outcome(), FolderOutcome::resumable);
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(OutputFolder, ForeignFolderIsRefusedAndNothingTouched) {
  const TemporaryFolder folder;
  put_file(folder / "thesis.tex", "precious");
  EXPECT_EQ(OutputFolder(folder.path(), identity).outcome(), FolderOutcome::foreign);
  EXPECT_EQ(test::entries(folder.path()), 1U);
  // A run.json that is not ours, or no JSON, does not help.
  for (const char* run :
       {"{\"state\": \"complete\"}", "[]", "not json", "{\"program\": \"epicyclic\", \"identity\": 3}",
        "{\"program\": \"other\", \"identity\": \"aa\"}"}) {
    put_file(folder / "run.json", run);
    EXPECT_EQ(OutputFolder(folder.path(), identity).outcome(), FolderOutcome::foreign) << run;
    EXPECT_EQ(contents(folder / "run.json"), run);
    EXPECT_EQ(test::entries(folder.path()), 2U);
  }
}

TEST(OutputFolder, WhatAKilledFirstSessionLeavesIsNotForeign) {
  const TemporaryFolder folder;
  put_file(folder / ".lock", "");
  put_file(folder / ".run.json.4711.0.tmp", "{");
  EXPECT_EQ(OutputFolder(folder.path(), identity).outcome(), FolderOutcome::fresh);
  EXPECT_FALSE(std::filesystem::exists(folder / ".run.json.4711.0.tmp"));
}

TEST(OutputFolder, TemporaryFilesOfAKilledSessionAreRemoved) {
  const TemporaryFolder folder;
  { const OutputFolder out(folder.path(), identity); }
  std::filesystem::create_directory(folder / "figures");
  put_file(folder / ".results.h5.4711.3.tmp", "half");
  put_file(folder / "figures/.a.dat.4711.4.tmp", "half");
  put_file(folder / "figures/a.dat", "whole");
  { const OutputFolder out(folder.path(), identity); }
  EXPECT_FALSE(std::filesystem::exists(folder / ".results.h5.4711.3.tmp"));
  EXPECT_FALSE(std::filesystem::exists(folder / "figures/.a.dat.4711.4.tmp"));
  EXPECT_TRUE(std::filesystem::exists(folder / "figures/a.dat"));
}

TEST(OutputFolder, UnusablePathIsAnOutputErrorWithPathAndReason) {
  const TemporaryFolder folder;
  put_file(folder / "file", "x");
  for (const auto& path : {folder / "file", folder / "file/below", std::filesystem::path("/proc/epicyclic/out")}) {
    const std::string message = message_of<OutputError>([&] { OutputFolder(path, identity); });
    EXPECT_TRUE(message.starts_with(path.string() + ": cannot create the folder: ")) << message;
  }
}

TEST(OutputFolder, FolderWithoutPermissionIsAnOutputError) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "closed");
  ASSERT_EQ(::chmod((folder / "closed").c_str(), 0500), 0);
  EXPECT_THROW(OutputFolder(folder / "closed", identity), OutputError);
  EXPECT_THROW(OutputFolder(folder / "closed/below", identity), OutputError);
  ASSERT_EQ(::chmod((folder / "closed").c_str(), 0700), 0);
}

TEST(OutputFolder, FullDiskKeepsTheOldRunJson) {
  const TemporaryFolder folder;
  const OutputFolder out(folder.path(), identity);
  const std::string before = contents(folder / "run.json");
  {
    const test::FileSizeLimit limit(10);
    EXPECT_THROW(out.write_run(RunState::complete, json::object()), OutputError);
  }
  EXPECT_EQ(contents(folder / "run.json"), before);
}

/// A complete study with two tables and a picture that was not drawn.
void complete(const std::filesystem::path& folder) {
  const OutputFolder out(folder, identity);
  write_file_atomically(folder / "points.csv", "1,2\n3,4\n");
  std::filesystem::create_directory(folder / "figures");
  write_file_atomically(folder / "figures/a.dat", "5 6\n");
  write_file_atomically(folder / "journal.bin", "not a result");
  report_placed(folder / "figures/a.png", Placed::undrawn);
  out.write_run(RunState::complete, json::object());
}

TEST(OutputFolder, CompleteStudyKnowsItsFiles) {
  const TemporaryFolder folder;
  complete(folder.path());
  const json files = run_of(folder.path())["files"];
  EXPECT_EQ(files.size(), 3U) << files;
  EXPECT_EQ(files["points.csv"]["bytes"], 8);
  EXPECT_EQ(files["figures/a.dat"]["sha256"], sha256_hex("5 6\n"));
  EXPECT_TRUE(files["figures/a.png"].is_null());
  const auto manifest = manifest_from(files);
  ASSERT_TRUE(manifest);
  EXPECT_EQ(to_json(*manifest), files);
  // Where nothing draws there is no other picture to be had.
  EXPECT_EQ(OutputFolder(folder.path(), identity, /*can_draw=*/false).outcome(), FolderOutcome::complete);
  EXPECT_EQ(OutputFolder(folder.path(), identity, /*can_draw=*/true).outcome(), FolderOutcome::damaged);
  // Drawn by somebody.
  put_file(folder / "figures/a.png", "a picture");
  EXPECT_EQ(OutputFolder(folder.path(), identity, /*can_draw=*/true).outcome(), FolderOutcome::complete);
}

TEST(OutputFolder, MissingCutOrChangedFilesMakeItDamagedAndAreSetAside) {
  const TemporaryFolder folder;
  const auto table = folder / "points.csv";
  for (const auto& [now, kept] : std::map<std::string, bool>{
           {"", false}, {"1,2\n", false}, {"1,3\n", true}, {"1,2\n3,5\n", true}, {"1,2\n3,4\n5,6\n", true}}) {
    std::filesystem::remove_all(folder / "figures");
    complete(folder.path());
    put_file(folder / "figures/a.png", "drawn");
    put_file(table, now);
    OutputFolder out(folder.path(), identity);
    ASSERT_EQ(out.outcome(), FolderOutcome::damaged) << now;
    ASSERT_EQ(out.changed().size(), 1U);
    EXPECT_EQ(out.changed()[0].name, "points.csv");
    EXPECT_EQ(out.changed()[0].bytes, now.size());
    EXPECT_FALSE(std::filesystem::exists(table));
    write_file_atomically(table, "1,2\n3,4\n");
    out.write_run(RunState::complete, json::object());
    EXPECT_EQ(std::filesystem::exists(folder / "points.csv.changed"), kept) << now;
    if (kept) {
      EXPECT_EQ(contents(folder / "points.csv.changed"), now);
    }
    std::filesystem::remove(folder / "points.csv.changed");
  }
  // Files of a complete study that are not known cannot be whole.
  json run = run_of(folder.path());
  run.erase("files");
  put_file(folder / "run.json", run.dump());
  const OutputFolder out(folder.path(), identity);
  EXPECT_EQ(out.outcome(), FolderOutcome::damaged);
  EXPECT_TRUE(out.changed().empty());
}

TEST(OutputFolder, ManifestNamesNothingOutsideTheFolder) {
  for (const char* name : {"../a", "/etc/passwd", "figures/../../a", ".", "", "figures/", "./a", "run.json", ".lock",
                           "journal.bin", "journal.rank-3.bin"})
    EXPECT_FALSE(manifest_from(json{{name, nullptr}})) << name;
  EXPECT_FALSE(manifest_from(json::parse(R"({"a": {"bytes": -1, "sha256": "b"}})")));
  EXPECT_FALSE(manifest_from(json::parse(R"({"a": {"bytes": 1}})")));
  EXPECT_FALSE(manifest_from(json::parse(R"([])")));
  EXPECT_TRUE(manifest_from(json::parse(R"({"figures/a.png": null})")));
}

TEST(OutputFolder, CompleteOnlyWithAllFilesThatWereWritten) {
  const TemporaryFolder folder;
  const OutputFolder out(folder.path(), identity);
  write_file_atomically(folder / "points.csv", "1,2\n");
  std::filesystem::remove(folder / "points.csv");
  EXPECT_THROW(out.write_run(RunState::complete, json::object()), OutputError);
  EXPECT_EQ(run_of(folder.path())["state"], "running");
}

TEST(OutputFolder, RemovedMovedOrReplacedFolderIsNoticed) {
  const TemporaryFolder parent;
  const auto path = parent / "out";
  for (const char* how : {"removed", "moved", "replaced"}) {
    const OutputFolder out(path, identity);
    EXPECT_TRUE(out.is_there());
    if (how == std::string_view("moved")) {
      std::filesystem::rename(path, parent / "elsewhere");
    } else {
      std::filesystem::remove_all(path);
    }
    if (how == std::string_view("replaced")) std::filesystem::create_directory(path);
    EXPECT_FALSE(out.is_there()) << how;
    const std::string message = message_of<OutputError>([&] { out.write_run(RunState::stopped, json::object()); });
    EXPECT_NE(message.find("removed or moved"), std::string::npos) << message;
    EXPECT_EQ(std::filesystem::exists(path), how == std::string_view("replaced"));
  }
  EXPECT_EQ(test::entries(path), 0U);
}

TEST(OutputFolder, FactsOfEarlierSessionsAreKept) {
  const TemporaryFolder folder;
  for (int session = 1; session <= 3; ++session) {
    const OutputFolder out(folder.path(), identity);
    out.write_run(RunState::running, {{"session", session}});
    // Twice, because within a session run.json is written more than once.
    out.write_run(RunState::stopped, {{"session", session}});
  }
  const json run = run_of(folder.path());
  EXPECT_EQ(run["session"], 3);
  EXPECT_EQ(run["earlier_sessions"], json::parse(R"([{"session": 1, "state": "stopped"},
                                                     {"session": 2, "state": "stopped"}])"));
}

TEST(Provenance, HoldsWhatTheCallerGaveAndWhatTheMachineIs) {
  Provenance provenance = begin_provenance();
  provenance.library_version = "0.1.0";
  provenance.commit = "abc";
  provenance.dependencies = {{"HDF5", "1.10.8"}};
  provenance.simd_level = "avx2";
  provenance.threads = 2;
  provenance.counts = {{"points", 1322}, {"failed", 0}};
  json facts = run_facts(provenance);
  EXPECT_FALSE(facts.contains("ended"));
  provenance.ended = utc_now();
  facts = run_facts(provenance);
  EXPECT_EQ(facts["dependencies"]["HDF5"], "1.10.8");
  EXPECT_EQ(facts["counts"]["points"], 1322);
  EXPECT_EQ(facts["simd"], "avx2");
  EXPECT_EQ(facts["process_id"], ::getpid());
  EXPECT_FALSE(facts["host"].get<std::string>().empty());
  EXPECT_FALSE(facts["cpu"].get<std::string>().empty());
  for (const char* time : {"started", "ended"}) {
    std::string shape = facts[time].get<std::string>();
    for (char& character : shape) character = character >= '0' && character <= '9' ? '0' : character;
    EXPECT_EQ(shape, "0000-00-00T00:00:00Z");
  }
}

}  // namespace
}  // namespace epicyclic::store::output_folder_test
