// epicyclic doctor: what is missing on this machine and what that means, a line each. Changes nothing.

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

#include "commands.hpp"
#include "figures/gnuplot.hpp"
#include "ranks/ranks.hpp"
#include "store/versions.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

namespace fs = std::filesystem;

constexpr double giga = 1e9;

void line(const char* what, const char* state, const std::string& meaning) {
  print("{:<9} {:<8} {}\n", what, state, meaning);
}

/// What a fixed command line of a shell prints; nothing if it fails or takes more than some seconds.
std::optional<std::string> output_of(const char* command) {
  const std::string whole = std::string("timeout 20 ") + command + " 2>/dev/null </dev/null";
  std::FILE* pipe = ::popen(whole.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 512> bytes;
  for (std::size_t n = 0; (n = std::fread(bytes.data(), 1, bytes.size(), pipe)) > 0;) text.append(bytes.data(), n);
  if (::pclose(pipe) != 0) return std::nullopt;
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

/// The first of the programs that PATH has.
std::string installed_program(std::initializer_list<const char*> names) {
  const char* path = std::getenv("PATH");
  const std::string_view folders = path != nullptr ? path : "/bin:/usr/bin";
  for (const char* name : names)
    for (std::size_t begin = 0; begin <= folders.size();) {
      const std::size_t end = std::min(folders.find(':', begin), folders.size());
      if (::access((fs::path(folders.substr(begin, end - begin)) / name).c_str(), X_OK) == 0) return name;
      begin = end + 1;
    }
  return {};
}

bool has_font() {
  const char* home = std::getenv("HOME");
  const fs::path own = home != nullptr ? fs::path(home) : fs::path("/nonexistent");
  for (const fs::path& folder :
       {fs::path("/usr/share/fonts"), fs::path("/usr/local/share/fonts"), own / ".local/share/fonts", own / ".fonts"}) {
    std::error_code none;
    for (fs::recursive_directory_iterator file(folder, fs::directory_options::skip_permission_denied, none), end;
         !none && file != end; file.increment(none))
      if (file->path().filename().string().starts_with("DejaVuSans")) return true;
  }
  return false;
}

/// Memory that a process can still get [bytes].
double available_memory() {
  double available = 0.0;
  std::ifstream memory("/proc/meminfo");
  for (std::string word; memory >> word;)
    if (word == "MemAvailable:" && memory >> available) available *= 1024;
  std::ifstream group("/sys/fs/cgroup/memory.max");
  if (double limit = 0.0; group >> limit) available = std::min(available, limit);
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    available = std::min(available, static_cast<double>(limit.rlim_cur));
  return available;
}

/// Of the current folder: can a study be written there?
bool judge_folder() {
  std::error_code none;
  const std::string here = fs::current_path(none).string();
  struct statvfs disk {};
  const bool known = ::statvfs(".", &disk) == 0;
  const double room = known ? static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize) : 0.0;
  if (::access(".", W_OK) != 0) {
    line("folder", "missing", here + ": cannot be written; go to another folder, or give one to -o");
    return false;
  }
  constexpr double least = 0.05 * giga;
  line("folder", room < least ? "missing" : "ok",
       fmt::format("{}: {:.3g} GB free{}", here, room / giga, room < least ? "; a study needs 0.05 GB or more" : ""));
  return room >= least;
}

bool judge_machine(int threads) {
  const double memory = available_memory();
  constexpr double least = 0.2 * giga;
  line("machine", memory < least ? "missing" : "ok",
       fmt::format("{} threads, {:.3g} GB of memory, SIMD {}{}", threads, memory / giga, store::simd_level(),
                   memory < least ? "; a study needs 0.2 GB or more" : ""));
  return memory >= least;
}

void judge_figures() {
  if (!figures::gnuplot_is_installed()) {
    line("gnuplot", "missing", "figures are not drawn, all else is computed. Debian: gnuplot-nox");
  } else {
    const std::string version = output_of("gnuplot --version").value_or("");
    const bool draws = output_of("gnuplot -e 'set terminal pngcairo; set terminal svg'").has_value();
    line("gnuplot", draws ? "ok" : "missing",
         version + (draws ? "" : "; its terminal pngcairo or svg is missing: no figures. Debian: gnuplot-nox"));
  }
  const bool font = has_font();
  line("fonts", font ? "ok" : "missing",
       font ? "DejaVu Sans"
            : "figures are drawn in another font, perhaps without Greek letters. Debian: "
              "fonts-dejavu-core");
}

void judge_mpi() {
  const std::string version = mpi_version();
  const std::string launcher = installed_program({"mpirun", "srun"});
  if (version.empty())
    line("MPI", "missing", "this program uses one process, with threads. Several hosts: epicyclic-mpi");
  else
    line("MPI", launcher.empty() ? "missing" : "ok",
         version + (launcher.empty() ? "; no mpirun or srun to start processes. Debian: openmpi-bin"
                                     : ", started by " + launcher));
}

void judge_readers() {
  const std::string browser =
      installed_program({"xdg-open", "x-www-browser", "firefox", "firefox-esr", "chromium", "google-chrome"});
  line("browser", browser.empty() ? "missing" : "ok",
       browser.empty() ? "report.html is written; copy it to a machine with a browser" : browser);
  const auto missing = output_of(
      "python3 -c \"from importlib.util import find_spec as f; print(' '.join(p for p in "
      "'epicyclic h5py pandas xarray h5netcdf matplotlib'.split() if f(p) is None))\"");
  if (!missing)
    line("Python", "missing", "no python3: results are read as CSV, HDF5 or in Octave");
  else
    line("Python", missing->empty() ? "ok" : "missing",
         missing->empty() ? "the package epicyclic and what it can use"
                          : "packages: " + *missing +
                                ". Reading results in Python needs epicyclic; DataFrame, xarray "
                                "and figures need the others");
}

}  // namespace

int doctor_command(const Arguments& arguments) {
  const bool folder = judge_folder();
  const bool machine = judge_machine(arguments.threads);
  judge_figures();
  judge_mpi();
  judge_readers();
  const bool able = folder && machine;
  line("studies", able ? "ok" : "missing", able ? "can be computed here" : "cannot be computed here");
  return able ? done : done_with_failures;
}

}  // namespace epicyclic::app
