#include "io/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/errors.hpp"
#include "io/atomic_file.hpp"
#include "io/csv.hpp"
#include "io/manifest.hpp"

namespace epicyclic::io {

namespace {

namespace fs = std::filesystem;

/// Longest part of gnuplot's own complaint that goes into a message [bytes].
constexpr std::size_t longest_complaint = 400;

constexpr std::string_view png_end("IEND\xae\x42\x60\x82", 8);
constexpr std::string_view svg_end = "</svg>";

/// How long a drawing may take: for a machine that is busy with other work.
constexpr std::chrono::seconds least_limit{120};
constexpr std::chrono::milliseconds limit_per_megabyte{10'000};
/// Of the one after one that hung; each gets half of the time of the one before, so that many figures cost minutes.
constexpr std::chrono::seconds last_limit{5};
std::atomic<int> hung_in_a_row{0};

using Clock = std::chrono::steady_clock;

/// The environment with all locale settings replaced by the C locale.
std::vector<std::string> c_locale_environment() {
  std::vector<std::string> variables{"LC_ALL=C"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text(*variable);
    if (!text.starts_with("LC_") && !text.starts_with("LANG")) variables.emplace_back(text);
  }
  return variables;
}

std::string text_of(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string reason(int error) { return std::generic_category().message(error); }

/// What gnuplot said, as one line without its picture of where in the line the error is.
std::string one_line(std::string_view complaint) {
  std::string line;
  for (const char character : complaint) {
    const bool blank = static_cast<unsigned char>(character) <= ' ' || character == '^';
    if (!blank) line += character;
    if (blank && !line.empty() && line.back() != ' ') line += ' ';
  }
  if (line.size() > longest_complaint) line = "... " + line.substr(line.size() - longest_complaint);
  return line;
}

std::chrono::milliseconds limit_for(fs::path script) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(script.replace_extension(".dat"), error);
  constexpr std::uintmax_t megabyte = 1'000'000;
  const std::chrono::milliseconds limit =
      least_limit + limit_per_megabyte * static_cast<std::int64_t>(error ? 0 : bytes / megabyte);
  constexpr int most_halves = 20;
  return std::max<std::chrono::milliseconds>(last_limit, limit / (1 << std::min(most_halves, hung_in_a_row.load())));
}

/// What a child process has said, its last words at least, and how it ended.
struct Ended {
  std::string words;
  std::optional<int> status;  ///< of waitpid; nothing: it had to be ended
  int error = 0;              ///< of a child that cannot be asked
};

/// Reads once from a pipe, when there is something within the time.
/// @returns false when nothing more will come
bool read_some(int pipe, int milliseconds, std::string& words) {
  constexpr std::size_t most_words = std::size_t{1} << 16;
  pollfd ready{pipe, POLLIN, 0};
  if (::poll(&ready, 1, milliseconds) <= 0) return true;
  std::array<char, 4096> block{};
  const ssize_t count = ::read(pipe, block.data(), block.size());
  if (count <= 0) return count < 0 && errno == EINTR;
  words.append(block.data(), static_cast<std::size_t>(count));
  if (words.size() > 2 * most_words) words.erase(0, words.size() - most_words);
  return true;
}

/// Listens to a child, the leader of its own process group, until it ends or the time is over. Nothing of the group is
/// left behind, not even a child's child that still holds the pipe.
Ended listen_to(pid_t child, int pipe, std::chrono::milliseconds limit) {
  constexpr int look_ms = 20;
  constexpr std::chrono::milliseconds moment{1};
  const Clock::time_point deadline = Clock::now() + limit;
  Ended result;
  bool listens = true;
  // It stays a zombie until its group is ended, or the group's number might be another's.
  const auto has_ended = [&] {
    siginfo_t state{};
    if (::waitid(P_PID, static_cast<id_t>(child), &state, WEXITED | WNOHANG | WNOWAIT) != 0 && errno != EINTR)
      result.error = errno;
    return state.si_pid == child;
  };
  bool ended = false;
  while (!(ended = has_ended()) && result.error == 0 && Clock::now() < deadline) {
    if (listens)
      listens = read_some(pipe, look_ms, result.words);
    else
      std::this_thread::sleep_for(moment);
  }
  if (result.error != 0) return result;
  ::kill(-child, SIGKILL);
  constexpr int pipe_blocks = 17;  // as many as a pipe holds, and the end
  for (int k = 0; k < pipe_blocks && listens; ++k) listens = read_some(pipe, 0, result.words);
  int status = 0;
  // A process that waits for a disk that is gone does not end: then it is left alone.
  const Clock::time_point patience = Clock::now() + std::chrono::seconds(5);
  for (pid_t gone = 0; gone != child; std::this_thread::sleep_for(moment)) {
    gone = ::waitpid(child, &status, WNOHANG);
    if (gone == child) break;
    if ((gone < 0 && errno != EINTR) || Clock::now() >= patience) return result;
  }
  if (ended) result.status = status;
  return result;
}

/// gnuplot does not always notice that its output could not be written (disk full), so the end of the file is checked.
bool ends_with(const FileDescriptor& picture, const fs::path& path, std::string_view end) {
  const off_t size = picture.is_open() ? ::lseek(picture.get(), 0, SEEK_END) : 0;
  if (size <= 0 || ::lseek(picture.get(), std::max<off_t>(0, size - 64), SEEK_SET) < 0) return false;
  return read_all(picture.get(), path).find(end) != std::string::npos;
}

std::string with_greek_letters(std::string_view text) {
  // Where the Symbol font has no Greek letter (digits, signs), the character stands for itself.
  static constexpr std::string_view latin = "abcdefghiklmnopqrstuwxyzDFGLPQSUWXY";
  static constexpr std::array<std::string_view, latin.size()> greek{
      "α", "β", "χ", "δ", "ε", "φ", "γ", "η", "ι", "κ", "λ", "μ", "ν", "ο", "π", "θ", "ρ", "σ",
      "τ", "υ", "ω", "ξ", "ψ", "ζ", "Δ", "Φ", "Γ", "Λ", "Π", "Θ", "Σ", "Υ", "Ω", "Ξ", "Ψ"};
  constexpr std::string_view opening = "{/Symbol ";
  std::string result;
  for (;;) {
    const std::size_t start = text.find(opening);
    if (start == std::string_view::npos) break;
    const std::size_t end = text.find_first_of("{}", start + opening.size());
    if (end == std::string_view::npos || text[end] != '}') break;
    result.append(text.substr(0, start)) += '{';
    for (const char letter : text.substr(start + opening.size(), end - start - opening.size())) {
      const std::size_t place = latin.find(letter);
      result += place == std::string_view::npos ? std::string_view(&letter, 1) : greek[place];
    }
    result += '}';
    text.remove_prefix(end + 1);
  }
  return result.append(text);
}

/// Length of the bar of an overprint, as "{.6-}", with which the text starts; 0 if it does not.
std::size_t bar_length(std::string_view text) {
  const std::size_t dash = text.starts_with('{') ? text.find_first_not_of("0123456789.", 1) : text.size();
  return dash < text.size() && text.substr(dash).starts_with("-}") ? dash + 2 : 0;
}

/// Each overprint of a bar, as "~x{.6-}" or "~{x}{.6-}", becomes the letter with a combining macron.
std::string with_macrons(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const bool in_braces = text.starts_with("~{");
    const std::size_t last = in_braces ? text.find_first_of("{}", 2) : 1;
    const std::size_t bar = text.front() == '~' && last < text.size() ? bar_length(text.substr(last + 1)) : 0;
    if (bar > 0 && (!in_braces || text[last] == '}')) {
      result.append(in_braces ? text.substr(2, last - 2) : text.substr(1, 1)) += "\u0304";
      text.remove_prefix(last + 1 + bar);
    } else {
      result += text.front();
      text.remove_prefix(1);
    }
  }
  return result;
}

/// What every script begins with.
std::string opening(std::string_view stem) {
  return fmt::format(
      "# Draws {0}.png and {0}.svg from {0}.dat. To draw again, run in this folder: gnuplot {0}.gp\n"
      "set encoding utf8\n"
      "set minussign\n"
      "set format xy '%h'\n"
      "set border 15 linewidth 1.2 linecolor '#202020'\n"
      "set tics in scale 0.9,0.45 textcolor '#202020'\n"
      "set mxtics 5\n"
      "set mytics 5\n",
      stem);
}

constexpr std::string_view png = "png";
constexpr std::string_view svg = "svg";

/// The commands, for each of the two files or for the one that the script is called with.
std::string drawn_to_files(std::string_view stem, std::string_view commands, const FigureCanvas& canvas = {}) {
  return fmt::format(
      "do for [kind in (ARGC > 0 ? ARG1 : '{1} {2}')] {{\n"
      "if (kind eq '{1}') {{\n"
      "set terminal pngcairo enhanced rounded size {3},{4} font 'DejaVu Sans,24' linewidth 1.5 background '#ffffff'\n"
      "mark = 1.4\n"
      "}} else {{\n"
      "set terminal svg enhanced round size {5},{6} font 'DejaVu Sans,24' linewidth 1.2 background '#ffffff'\n"
      "mark = 0.7\n"
      "}}\n"
      "set output '{0}.'.kind\n"
      "{7}"
      "unset output\n"
      "}}\n",
      stem, png, svg, canvas.width, canvas.height, 4 * canvas.width / 5, 4 * canvas.height / 5, commands);
}

}  // namespace

void FigureRange::include(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

FigureRange FigureRange::widened(double share) const {
  const double margin = high > low ? share * (high - low) : std::max(1e-12, 0.05 * std::abs(low));
  return {low - margin, high + margin};
}

bool gnuplot_is_installed() {
  const char* variable = std::getenv("PATH");
  std::string_view folders = variable != nullptr ? variable : "/bin:/usr/bin";
  for (;;) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const fs::path folder(end > 0 ? folders.substr(0, end) : ".");
    if (::access((folder / "gnuplot").c_str(), X_OK) == 0) return true;
    if (end == folders.size()) return false;
    folders.remove_prefix(end + 1);
  }
}

FigureOutcome run_gnuplot(const fs::path& script, Pictures which, std::optional<std::chrono::milliseconds> limit) {
  const fs::path folder = script.has_parent_path() ? script.parent_path() : fs::path(".");
  std::array<int, 2> pipe_ends{};
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return {"cannot run gnuplot: " + reason(errno)};
  const FileDescriptor read_end(pipe_ends[0]);
  FileDescriptor write_end(pipe_ends[1]);

  std::vector<std::string> variables = c_locale_environment();
  std::vector<char*> environment;
  environment.reserve(variables.size() + 1);
  for (std::string& variable : variables) environment.push_back(variable.data());
  environment.push_back(nullptr);
  // "./" keeps a script whose name begins with a dash from being taken for an option.
  std::string program = "gnuplot";
  std::string without_user_settings = "-d";
  std::string called_with_argument = "-c";
  std::string script_name = "./" + script.filename().string();
  std::string argument(which == Pictures::svg ? svg : png);
  std::array<char*, 6> arguments{
      program.data(), without_user_settings.data(), called_with_argument.data(), script_name.data(), argument.data(),
      nullptr};
  if (which == Pictures::both) arguments = {program.data(), without_user_settings.data(), script_name.data(), nullptr};

  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  // Our stdout belongs to the data.
  ::posix_spawn_file_actions_adddup2(&actions, write_end.get(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, write_end.get(), STDERR_FILENO);
  // Signals that this process blocks or ignores (SIGXFSZ, SIGPIPE) are none of gnuplot's business.
  sigset_t none;
  sigset_t all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  // Nor is Ctrl-C on a terminal, which goes to the whole process group: this process decides what is drawn to the end.
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  const int error =
      ::posix_spawnp(&child, program.c_str(), &actions, &attributes, arguments.data(), environment.data());
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  write_end = FileDescriptor();
  if (error == ENOENT && fs::exists(folder)) {
    return {"gnuplot is not installed (Debian: apt install gnuplot-nox); the figure's data and script are written"};
  }
  if (error != 0) return {"cannot run gnuplot: " + reason(error)};

  const std::chrono::milliseconds patience = limit.value_or(limit_for(script));
  const Ended gnuplot = listen_to(child, read_end.get(), patience);
  if (gnuplot.error != 0) return {"lost sight of gnuplot: " + reason(gnuplot.error)};
  if (!gnuplot.status) {
    ++hung_in_a_row;
    return {
        fmt::format("gnuplot did not come to an end within {:.1f} s and was stopped; the figure's data and script are "
                    "written: gnuplot {}",
                    std::chrono::duration<double>(patience).count(), script.string())};
  }
  hung_in_a_row = 0;
  if (WIFSIGNALED(*gnuplot.status)) return {fmt::format("gnuplot was killed by signal {}", WTERMSIG(*gnuplot.status))};
  if (WEXITSTATUS(*gnuplot.status) != 0)
    return {fmt::format("gnuplot failed on {}: {}", script.string(), one_line(gnuplot.words))};
  return {};
}

std::string gnuplot_quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char character : text) {
    if (character == '\'') quoted += '\'';
    // A line break would end gnuplot's command.
    quoted += static_cast<unsigned char>(character) < ' ' ? ' ' : character;
  }
  return quoted + "'";
}

std::string portable_text(std::string_view text) { return with_macrons(with_greek_letters(text)); }

std::string figure_script(std::string_view stem, const FigureText& text, const FigureRange& x, const FigureRange& y,
                          std::size_t legend_entries, const std::vector<FigureMarker>& markers, std::string_view extra,
                          std::string_view plot, const FigureCanvas& canvas) {
  std::string script = opening(stem);
  script += fmt::format(
      "set xrange [{0}:{1}]\n"
      "set yrange [{2}:{3}]\n"
      "set xlabel {4}\n"
      "set ylabel {5}\n"
      "set rmargin screen 0.975\n",
      text_of(x.low), text_of(x.high), text_of(y.low), text_of(y.high), gnuplot_quoted(portable_text(text.x_label)),
      gnuplot_quoted(portable_text(text.y_label)));
  // Title on the left and legend on the right of one line, if both are short: gnuplot's own title takes a second line.
  if (!text.title.empty()) {
    const std::string title = gnuplot_quoted(portable_text(text.title));
    script += legend_entries > 2 ? fmt::format("set title {}\n", title)
                                 : fmt::format("set label {} at graph 0, graph 1 left offset character 0,0.9\n", title);
  }
  if (legend_entries > 0) {
    script += "set key above right horizontal Left reverse samplen 1.5 width 1 font ',22'\n";
  } else {
    script += fmt::format("unset key\nset tmargin {}\n", text.title.empty() ? 1.0 : 2.4);
  }
  if (!markers.empty()) script += "set style textbox opaque noborder fillcolor '#ffffff' margins 0.4,0.4\n";
  for (const FigureMarker& marker : markers) {
    if (!(marker.x >= x.low && marker.x <= x.high)) continue;
    script += fmt::format(
        "set arrow from first {0}, graph 0 to first {0}, graph 1 nohead back linewidth 1.2 dashtype (8,6) "
        "linecolor '#808080'\n"
        "set label {1} at first {0}, graph 0.985 rotate by 90 right offset character -1,0 font ',18' "
        "textcolor '#404040' front boxed\n",
        text_of(marker.x), gnuplot_quoted(portable_text(marker.label)));
  }
  script += extra;
  return script + drawn_to_files(stem, fmt::format("plot {}\n", plot), canvas);
}

std::string panel_script(std::string_view stem, std::string_view extra, std::string_view panels) {
  return fmt::format("{}set rmargin screen 0.975\n{}{}", opening(stem), extra, drawn_to_files(stem, panels));
}

FigureOutcome draw_pictures(const fs::path& folder, std::string_view stem, Pictures which) {
  if (which == Pictures::none) return {};
  const auto named = [&](std::string_view suffix) { return folder / fmt::format("{}.{}", stem, suffix); };
  const FigureOutcome outcome = run_gnuplot(named("gp"), which);
  const auto take = [&](std::string_view suffix, std::string_view end) {
    const fs::path path = named(suffix);
    if (!outcome.drawn()) {
      std::error_code ignored;
      fs::remove(path, ignored);  // a part of it
      return note_undrawn(path);
    }
    const FileDescriptor picture = open_descriptor(path, O_RDONLY);
    if (!ends_with(picture, path, end)) {
      throw OutputError(
          fmt::format("{}: gnuplot did not finish it (disk full?); make room and repeat the command", path.string()));
    }
    sync_descriptor(picture.get(), path);
    note_file(path);
  };
  if (which != Pictures::svg) take(png, png_end);
  if (which != Pictures::png) take(svg, svg_end);
  if (outcome.drawn()) sync_folder(folder);
  return outcome;
}

FigureOutcome draw_figure(const fs::path& folder, std::string_view stem, std::string_view data, std::string_view script,
                          Pictures which) {
  return draw_figure(
      folder, stem, [data](AtomicFile& file) { file.write(data); }, script, which);
}

FigureOutcome draw_figure(const fs::path& folder, std::string_view stem,
                          const std::function<void(AtomicFile&)>& write_data, std::string_view script, Pictures which) {
  const bool plain = !stem.empty() && stem.front() != '.' && std::ranges::all_of(stem, [](char character) {
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
           (character >= '0' && character <= '9') || character == '_' || character == '-' || character == '.';
  });
  if (!plain) throw std::invalid_argument(fmt::format("draw_figure: '{}' is not a plain file name", stem));
  std::error_code error;
  // Not its parents: an output folder that was removed meanwhile must not come back as one of unknown origin.
  create_folder(folder, /*parents=*/false);

  const auto named = [&](std::string_view suffix) { return folder / fmt::format("{}{}", stem, suffix); };
  // An old picture must not pass for one of these data.
  for (const std::string_view suffix : {".png", ".svg"}) fs::remove(named(suffix), error);
  AtomicFile data(named(".dat"));
  write_data(data);
  data.commit();
  write_file_atomically(named(".gp"), script);
  return draw_pictures(folder, stem, which);
}

}  // namespace epicyclic::io
