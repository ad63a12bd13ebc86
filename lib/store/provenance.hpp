// Origin of a study: program, machine, input files and time. These volatile facts are in run.json and nowhere else. So
// all other files of a study are the same bytes on each machine and day.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace epicyclic::store {

/// The facts of one session, that is, of one call of the program on an output folder.
struct Provenance {
  std::string library_version;                      ///< given by the caller
  std::string commit;                               ///< given by the caller
  std::map<std::string, std::string> dependencies;  ///< name -> version; given by the caller
  std::string simd_level;                           ///< given by the caller: "baseline", "avx2", ...
  int threads = 1;                                  ///< of this process; given by the caller
  int ranks = 1;                                    ///< processes; given by the caller
  std::map<std::string, std::string> input_files;   ///< copy in the folder -> name of the file; given by the caller
  std::map<std::string, std::int64_t> counts;       ///< points, failed points, ...; given by the caller
  std::optional<double> occupancy;                  ///< of lanes; nothing where there were none
  std::string host;
  std::string cpu_model;
  std::int64_t process_id = 0;
  std::string started;  ///< UTC, ISO 8601
  std::string ended;    ///< UTC, ISO 8601; empty while running
};

/// Now in UTC, as 2026-03-01T12:34:56Z.
std::string utc_now();

/// A Provenance with host, processor, process and start time; facts that cannot be found are "unknown".
Provenance begin_provenance();

/// The facts as they stand in run.json; see OutputFolder::write_run.
nlohmann::json run_facts(const Provenance& provenance);

}  // namespace epicyclic::store
