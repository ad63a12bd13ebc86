#include "store/provenance.hpp"

#include <array>
#include <ctime>
#include <fstream>

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

namespace epicyclic::store {

namespace {

std::string host_name() {
  std::array<char, 256> name{};
  // One byte less than there is: gethostname need not terminate a name that it cuts.
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const auto start = line.find_first_not_of(" \t", line.find(':') + 1);
    if (start != std::string::npos) return line.substr(start);
  }
  return "unknown";
}

}  // namespace

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

Provenance begin_provenance() {
  Provenance provenance;
  provenance.host = host_name();
  provenance.cpu_model = cpu_model();
  provenance.process_id = ::getpid();
  provenance.started = utc_now();
  return provenance;
}

nlohmann::json run_facts(const Provenance& provenance) {
  nlohmann::json facts = {
      {"version", provenance.library_version},
      {"commit", provenance.commit},
      {"dependencies", provenance.dependencies},
      {"simd", provenance.simd_level},
      {"threads", provenance.threads},
      {"ranks", provenance.ranks},
      {"input_files", provenance.input_files},
      {"counts", provenance.counts},
      {"host", provenance.host},
      {"cpu", provenance.cpu_model},
      {"process_id", provenance.process_id},
      {"started", provenance.started},
  };
  if (provenance.occupancy) facts["occupancy"] = *provenance.occupancy;
  if (!provenance.ended.empty()) facts["ended"] = provenance.ended;
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) == 0) facts["peak_memory_KiB"] = usage.ru_maxrss;
  return facts;
}

}  // namespace epicyclic::store
