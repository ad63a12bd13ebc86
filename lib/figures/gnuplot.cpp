#include "figures/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
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

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "core/errors.hpp"
#include "core/placed_files.hpp"
#include "core/text.hpp"

namespace epicyclic::figures {

namespace {

namespace fs = std::filesystem;

/// Longest part of gnuplot's own complaint that goes into a message [bytes].
constexpr std::size_t longest_complaint = 400;

constexpr std::string_view png_end("IEND\xae\x42\x60\x82", 8);
constexpr std::string_view svg_end = "</svg>";
constexpr std::string_view pdf_end = "%%EOF";

/// How long a drawing may take: for a machine that is busy with other work.
constexpr std::chrono::seconds least_limit{120};
constexpr std::chrono::milliseconds limit_per_megabyte{10'000};
/// Of the one after one that hung; each gets half of the time of the one before, so that many figures cost minutes.
constexpr std::chrono::seconds last_limit{5};
std::atomic<int> hung_in_a_row{0};

using Clock = std::chrono::steady_clock;

/// The environment with all locale settings replaced by the C locale.
std::vector<std::string> c_locale_environment() {
  std::vector<std::string> variables{"LC_ALL=C", "TZ=UTC0"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text(*variable);
    if (!text.starts_with("LC_") && !text.starts_with("LANG") && !text.starts_with("TZ=")) variables.emplace_back(text);
  }
  return variables;
}

std::string text_of(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string reason(int error) { return std::generic_category().message(error); }

/// The message of gnuplot as one line, without the marks below the place of the error.
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

/// Output of a child process, at least its last words, and how it ended.
struct Ended {
  std::string words;
  std::optional<int> status;  ///< of waitpid; nothing: it had to be ended
  int error = 0;              ///< of a child whose state cannot be read
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
  constexpr int poll_ms = 20;
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
      listens = read_some(pipe, poll_ms, result.words);
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
    if (start > 0 && text[start - 1] == '\\') {  // as somebody has typed it
      result.append(text.substr(0, start + opening.size()));
      text.remove_prefix(start + opening.size());
      continue;
    }
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
constexpr std::string_view pdf = "pdf";

/// The commands, for each of the files or for the one that the script is called with.
std::string drawn_to_files(std::string_view stem, std::string_view commands, const FigureCanvas& canvas = {}) {
  constexpr double svg_share = 0.8;
  constexpr double pdf_share = 0.28;  // of a point of a page for each pixel: two columns of a journal are 7 inches
  constexpr double points_per_inch = 72;
  const auto pixels = [&](int length, double share) {
    return static_cast<int>(std::floor(static_cast<double>(std::lround(length * canvas.scale)) * share + 1e-9));
  };
  const auto scaled = [](double scale) {
    return scale == 1.0 ? std::string() : fmt::format(" fontscale {0} pointscale {0}", text_of(scale));
  };
  std::string script = fmt::format(
      "do for [kind in (ARGC > 0 ? ARG1 : '{1} {2}{3}')] {{\n"
      "if (kind eq '{1}') {{\n"
      "set terminal pngcairo enhanced rounded size {4},{5} font 'DejaVu Sans,24'{6} linewidth {7} background "
      "'#ffffff'\n"
      "mark = 1.4\n",
      stem, png, svg, canvas.pdf ? " pdf" : "", pixels(canvas.width, 1.0), pixels(canvas.height, 1.0),
      scaled(canvas.scale), text_of(1.5 * canvas.scale));
  if (canvas.pdf) {
    const double share = pdf_share * canvas.scale / points_per_inch;
    script += fmt::format(
        "}} else {{ if (kind eq '{}') {{\n"
        "set terminal pdfcairo enhanced rounded size {}in,{}in font 'DejaVu Sans,24'{} linewidth {} background "
        "'#ffffff'\n"
        "mark = 1.4\n",
        pdf, text_of(canvas.width * share), text_of(canvas.height * share), scaled(pdf_share * canvas.scale),
        text_of(1.5 * pdf_share * canvas.scale));
  }
  script += fmt::format(
      "}} else {{\n"
      "set terminal svg enhanced round size {},{} font 'DejaVu Sans,24'{} linewidth {} background '#ffffff'\n"
      "mark = 0.7\n"
      "{}}}\n",
      pixels(canvas.width, svg_share), pixels(canvas.height, svg_share),
      canvas.scale == 1.0 ? std::string() : fmt::format(" fontscale {}", text_of(canvas.scale)),
      text_of(1.2 * canvas.scale), canvas.pdf ? "}" : "");
  return script + fmt::format("set output '{}.'.kind\n{}unset output\n}}\n", stem, commands);
}

// ---------------------------------------------------------------------------------------------------------------------
// Texts

constexpr char32_t no_character = 0xfffd;

/// Of UTF-8; what is none stands as no_character.
std::vector<char32_t> code_points(std::string_view text) {
  std::vector<char32_t> points;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80U ? 1 : lead >= 0xf0U ? 4 : lead >= 0xe0U ? 3 : lead >= 0xc0U ? 2 : 0;
    constexpr std::array<unsigned, 5> bits{0, 0x7fU, 0x1fU, 0x0fU, 0x07U};
    char32_t point = lead & bits[length];
    std::size_t k = 1;
    for (; k < length && i + k < text.size(); ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xc0U) != 0x80U) break;
      point = (point << 6U) | (next & 0x3fU);
    }
    points.push_back(length > 0 && k == length ? point : no_character);
    i += std::max<std::size_t>(1, length > 0 && k == length ? length : 1);
  }
  return points;
}

void append_utf8(std::string& text, char32_t point) {
  const auto byte = [&](char32_t value) { text += static_cast<char>(value); };
  const auto next = [&](unsigned shift) { byte(0x80U | ((point >> shift) & 0x3fU)); };
  if (point < 0x80U) {
    byte(point);
  } else if (point < 0x800U) {
    byte(0xc0U | (point >> 6U));
    next(0);
  } else if (point < 0x10000U) {
    byte(0xe0U | (point >> 12U));
    next(6);
    next(0);
  } else {
    byte(0xf0U | (point >> 18U));
    next(12);
    next(6);
    next(0);
  }
}

bool between(char32_t point, char32_t first, char32_t last) { return point >= first && point <= last; }

/// No control character, no separator of lines, nothing that XML forbids in an SVG file.
bool has_picture(char32_t point) {
  return point >= U' ' && !between(point, 0x7f, 0x9f) && !between(point, 0x2028, 0x2029) &&
         !between(point, 0xd800, 0xdfff) && !between(point, 0xfdd0, 0xfdef) && (point & 0xfffeU) != 0xfffeU;
}

/// Embeddings, overrides and isolates of directions, which would reach into the words beside a name.
bool is_direction_control(char32_t point) {
  return between(point, 0x202a, 0x202e) || between(point, 0x2066, 0x2069) || between(point, 0x200e, 0x200f) ||
         point == 0x061c;
}

/// Hebrew, Arabic and their neighbours.
bool from_the_right(char32_t point) {
  return between(point, 0x0590, 0x08ff) || between(point, 0xfb1d, 0xfdff) || between(point, 0xfe70, 0xfeff) ||
         between(point, 0x10800, 0x10fff) || between(point, 0x1e800, 0x1efff);
}

/// Probably not in the font of the figures: beyond Latin, Greek, Cyrillic and signs.
bool is_rare(char32_t point) {
  return point >= 0x0530 && !between(point, 0x1e00, 0x23ff) && !between(point, 0x2500, 0x27bf) && point != no_character;
}

/// Of DejaVu Sans, in heights of the font.
double width_of(char32_t point) {
  constexpr std::u32string_view narrow = U" ijltfrI.,:;'|!()[]/\\-";
  constexpr std::u32string_view wide = U"mwMW%@";
  if (between(point, 0x0300, 0x036f) || between(point, 0x200b, 0x200f)) return 0.0;
  if (point >= 0x1100 && !between(point, 0x1e00, 0x23ff)) return 1.2;
  if (narrow.find(point) != std::u32string_view::npos) return 0.4;
  if (wide.find(point) != std::u32string_view::npos) return 1.0;
  return point >= U'a' ? 0.63 : 0.69;
}

/// A character of a name in "enhanced" notation.
void append_verbatim(std::string& text, char32_t point) {
  constexpr std::u32string_view markup = U"_^{}@&~";
  if (point == U'\\') {
    // By itself: pngcairo shows the escape of a backslash, and both files make a letter of one before "U+0041".
    text += "{\\\\}";
  } else if (point == U'>') {
    // Apart from what is before it: the SVG file does not escape it, and XML forbids it behind two brackets.
    text += "{>}";
  } else {
    if (markup.find(point) != std::u32string_view::npos) text += '\\';
    append_utf8(text, point);
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// Layout, in pixels of the PNG picture

constexpr double font_height = 32;         // of size 24
constexpr double legend_font_height = 29;  // of size 22
constexpr double right_edge = 0.975;       // of the canvas, or as far as the last tic of the abscissa has room

/// Tags of labels beyond those that gnuplot gives.
constexpr int title_tag = 1000;
constexpr int label_tag = 1001;

/// %h has six digits: more where the range is a small part of its values.
std::string more_digits(std::string_view axis, const FigureRange& range) {
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  return fmt::format("set format {} '{}'\n", axis, range.high - range.low < 1e-3 * largest ? "%.9h" : "%h");
}

/// Estimated width of the labels of tics.
double tic_width(const FigureRange& range) {
  constexpr double tics = 6;
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  const double step = (range.high - range.low) / tics;
  if (!(step > 0.0) || !(largest > 0.0)) return font_height;
  const double before = std::max(1.0, std::floor(std::log10(largest)) + 1.0);
  const double behind = std::max(0.0, -std::floor(std::log10(step)));
  const double characters = before + behind + (behind > 0.0 ? 1.0 : 0.0) + (range.low < 0.0 ? 1.0 : 0.0);
  return 0.64 * font_height * std::min(characters, 11.0) + 20.0;
}

FigureRange above_of(const SecondAbscissa& above, const FigureRange& x) {
  return {x.low * above.factor, x.high * above.factor};
}

/// The frame's right edge, in parts of the canvas: half of the last tic's label has room beside it, below and above.
double right_edge_of(const FigureText& text, const FigureRange& x, const FigureCanvas& canvas) {
  constexpr double beside = 20.0;  // of tic_width()
  constexpr double least = 8.0;
  double widest = tic_width(x);
  if (text.above) widest = std::max(widest, tic_width(above_of(*text.above, x)));
  return std::min(right_edge, 1.0 - (0.5 * (widest - beside) + least) / canvas.width);
}

/// What stands above the frame.
struct Head {
  std::string settings;  ///< of the legend and of the upper margin
  std::string title;     ///< the command that sets it, for each of the two files
  double height = 0;     ///< from the upper edge of the canvas to the frame [pixels]
};

/// The title as an expression. If no font has a character, pngcairo covers the figure with a sign for it. In that case
/// the PNG file shows no_character instead.
std::string title_expression(const std::string& title) {
  std::vector<char32_t> points = code_points(title);
  std::string rare;
  for (char32_t& point : points) {
    if (!is_rare(point)) continue;
    const std::string code = fmt::format(" {:x}", static_cast<std::uint32_t>(point));
    if (rare.find(code + ' ') == std::string::npos) rare += code + ' ';
    point = no_character;
  }
  if (rare.empty()) return gnuplot_quoted(title);
  std::string plain;
  for (const char32_t point : points) append_utf8(plain, point);
  return fmt::format(
      "(kind eq '{}' && system('for c in{}; do fc-list :charset=$c family 2>/dev/null | grep -q . || echo none; "
      "done') ne '' ? {} : {})",
      png, rare, gnuplot_quoted(plain), gnuplot_quoted(title));
}

/// Height of names on edge below the frame, beyond the height of a number [pixels].
double room_of_names(const FigureText& text) {
  double longest = 0.0;
  for (const auto& [at, name] : text.x_names) longest = std::max(longest, text_width(name));
  return std::max(0.0, longest - 1.0) * font_height;
}

/// Neither a second abscissa nor names on edge take anything from the frame.
FigureCanvas with_room(FigureCanvas canvas, const FigureText& text) {
  if (text.above) canvas.height += second_abscissa_height;
  canvas.height += static_cast<int>(std::lround(room_of_names(text)));
  return canvas;
}

/// The abscissa above the frame, if there is one.
std::string second_abscissa_of(const FigureText& text, const FigureRange& x) {
  if (!text.above) return {};
  const FigureRange above = above_of(*text.above, x);
  return fmt::format(
      "set xtics nomirror\nset x2range [{}:{}]\nset x2tics\nset mx2tics 5\n{}set x2label {} offset 0,-0.4\n",
      text_of(above.low), text_of(above.high), more_digits("x2", above),
      gnuplot_quoted(portable_text(text.above->label)));
}

/// The characters of a text with gnuplot's markup that are drawn.
std::u32string seen_characters(std::string_view text) {
  std::u32string seen;
  bool escaped = false;
  for (const char32_t point : code_points(text)) {
    const bool markup =
        !escaped && (point == U'\\' || point == U'{' || point == U'}' || point == U'_' || point == U'^');
    escaped = !escaped && point == U'\\';
    if (!markup) seen += point;
  }
  return seen;
}

constexpr double usual_left = 190;  // of the frame, at most [pixels]

/// @param left  edge of the frame [pixels]
Head head_of(const FigureText& text, const std::vector<std::string>& legend, const FigureCanvas& canvas,
             double left = usual_left) {
  constexpr double pad = 12;
  constexpr double title_line = 46;
  constexpr double legend_line = 34;
  constexpr double above_frame = 16;
  constexpr double least_font = 10;
  const double width = right_edge * canvas.width - left;
  const std::string title = portable_text(text.title);
  const double title_width = font_height * text_width(title);
  const auto vertical = [&](double pixels) { return text_of(1.0 - pixels / canvas.height); };
  Head head;
  double y = pad;
  if (!title.empty()) {
    const double font = std::max(least_font, std::floor(std::min(24.0, 24.0 * width / title_width)));
    head.title = fmt::format("set label {} {} at graph 0, screen {} left font ',{}'\n", title_tag,
                             title_expression(title), vertical(y + 0.5 * title_line), text_of(font));
    y += title_line;
  }
  if (legend.empty()) {
    head.settings += "unset key\n";
  } else {
    // gnuplot makes all columns as wide as the longest entry, and counts 0.65 heights of the font for a character,
    // which is mostly more than they have.
    constexpr double character = 0.65;
    constexpr double gap = 0.5;
    double widest = 0.0;
    double characters = 0.0;
    for (const std::string& entry : legend) {
      const std::string shown = portable_text(entry);
      widest = std::max(widest, text_width(shown));
      characters = std::max(characters, static_cast<double>(seen_characters(shown).size()));
    }
    const double narrower = std::clamp(characters - widest / character - gap, -3.0, 3.0);
    constexpr double sample = 4.3;  // with the gaps about it, in characters
    const double column = character * legend_font_height * (characters + sample - narrower);
    const auto entries = static_cast<double>(legend.size());
    const double columns = std::clamp(std::floor(width / column), 1.0, entries);
    const double rows = std::ceil(entries / columns);
    const bool beside = !title.empty() && title_width + entries * column + 2.0 * font_height < width;
    if (beside) y = pad + 0.5 * (title_line - legend_line);
    head.settings += fmt::format(
        "set key at graph 1, screen {} right top horizontal maxcols {} maxrows {} Left reverse samplen 1.5 width "
        "{:.1f} "
        "font ',22'\n",
        vertical(y), columns, rows, -narrower);
    y = beside ? pad + title_line : y + rows * legend_line;
  }
  head.height = std::min(y + above_frame, 0.6 * canvas.height);
  if (title.empty() && legend.empty()) head.height = 24;  // half a label of a tic
  if (text.above) head.height += second_abscissa_height;
  head.settings += fmt::format("set tmargin screen {}\n", vertical(head.height));
  return head;
}

/// @param folder  that it runs in
/// @param output  descriptor that takes what it says
/// @param child   replaced by its process
/// @returns the error number, 0 if it was started
int start_gnuplot(const fs::path& folder, const fs::path& script, Pictures which, int output, pid_t& child) {
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
  std::string argument(which == Pictures::svg ? svg : which == Pictures::pdf ? pdf : png);
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
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
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
  const int error =
      ::posix_spawnp(&child, program.c_str(), &actions, &attributes, arguments.data(), environment.data());
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  return error;
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
  pid_t child = 0;
  const int error = start_gnuplot(folder, script, which, write_end.get(), child);
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
  // In single quotes no character has a meaning, but gnuplot misreads two apostrophes side by side.
  const bool single = text.find('\'') == std::string_view::npos;
  constexpr std::string_view meaning = "\"\\`@";
  std::string quoted;
  for (const char character : text) {
    // A line break would end gnuplot's command.
    if (static_cast<unsigned char>(character) < ' ')
      quoted += ' ';
    else if (!single && meaning.find(character) != std::string_view::npos)
      quoted += fmt::format("\\{:03o}", character);
    else
      quoted += character;
  }
  return single ? "'" + quoted + "'" : '"' + quoted + '"';
}

std::string portable_text(std::string_view text) { return with_macrons(with_greek_letters(text)); }

std::string verbatim_text(std::string_view typed) {
  constexpr double longest = 44;  // font heights
  constexpr double kept_at_end = 14;
  std::vector<char32_t> points = code_points(typed);
  std::erase_if(points, is_direction_control);
  double width = 0.0;
  for (char32_t& point : points) {
    if (!has_picture(point)) point = U' ';
    width += width_of(point);
  }
  if (width > longest) {
    auto last = points.end();
    for (double w = 0.0; w < kept_at_end; --last) w += width_of(*(last - 1));
    auto first = points.begin();
    for (double w = 0.0; w < longest - kept_at_end; ++first) w += width_of(*first);
    *first = U'…';
    points.erase(first + 1, last);
  }
  std::string text;
  for (const char32_t point : points) append_verbatim(text, point);
  // The words beside a name that is written from the right stay where they are.
  constexpr std::string_view from_the_left = "\u200e";
  if (std::ranges::any_of(points, from_the_right)) text = fmt::format("{0}{1}{0}", from_the_left, text);
  return text;
}

double text_width(std::string_view text) {
  double width = 0.0;
  for (const char32_t point : seen_characters(text)) width += width_of(point);
  return width;
}

std::string logarithmic_axis(std::string_view axis, const FigureRange& range) {
  const double decades = std::log10(range.high / range.low);
  const std::string scale = fmt::format("set logscale {0}\nset m{0}tics 10\n", axis);
  if (decades >= 3.0) return scale + fmt::format("set format {0} '10^{{%T}}'\nset {0}tics autofreq\n", axis);
  std::string tics;
  const auto add = [&](double value, const std::string& label, bool named) {
    tics += fmt::format("{}'{}' {} {}", tics.empty() ? "" : ", ", named ? label : "", text_of(value), named ? 0 : 1);
  };
  constexpr double few_digits = 0.3;
  if (decades < few_digits) {
    // Too short for powers and their parts: equal steps, as on a linear scale.
    constexpr double about = 5;
    const double rough = (range.high - range.low) / about;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = (rough < 2.0 * power ? 2.0 : rough < 5.0 * power ? 5.0 : 10.0) * power;
    for (double k = std::ceil(range.low / step); k * step <= range.high; ++k)
      add(k * step, short_text(k * step, 9), true);
    return scale + fmt::format("set {}tics ({})\n", axis, tics);
  }
  for (int power = static_cast<int>(std::floor(std::log10(range.low))); std::pow(10.0, power) <= range.high; ++power)
    for (int digit = 1; digit < 10; ++digit) {
      const double value = digit * std::pow(10.0, power);
      if (value < range.low || value > range.high) continue;
      const bool named = digit == 1 || digit == 2 || digit == 5 || decades < 1.0;
      const std::string label = power >= -2 && power <= 3 ? short_text(value, 6)
                                : digit == 1              ? fmt::format("10^{{{}}}", power)
                                                          : fmt::format("{}·10^{{{}}}", digit, power);
      add(value, label, named);
    }
  return scale + fmt::format("set {}tics ({})\n", axis, tics);
}

std::string figure_script(std::string_view stem, const FigureText& text, const FigureRange& x, const FigureRange& y,
                          const std::vector<std::string>& legend, const std::vector<FigureMarker>& markers,
                          std::string_view extra, std::string_view plot, const FigureCanvas& given) {
  const FigureCanvas canvas = with_room(given, text);
  const Head head = head_of(text, legend, canvas);
  std::string script = opening(stem);
  script += fmt::format(
      "set xrange [{0}:{1}]\n"
      "set yrange [{2}:{3}]\n"
      "set xlabel {4}\n"
      "set ylabel {5}\n"
      "set rmargin screen {6}\n",
      text_of(x.low), text_of(x.high), text_of(y.low), text_of(y.high), gnuplot_quoted(portable_text(text.x_label)),
      gnuplot_quoted(portable_text(text.y_label)), text_of(right_edge_of(text, x, canvas)));
  script += more_digits("x", x) + more_digits("y", y) + head.settings + second_abscissa_of(text, x);
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
  return script + drawn_to_files(stem, fmt::format("{}plot {}\n", head.title, plot), canvas);
}

namespace {

std::string named_tics(const std::vector<std::pair<double, std::string>>& names) {
  std::string list;
  for (const auto& [at, name] : names)
    list += fmt::format("{}{} {}", list.empty() ? "(" : ", ", gnuplot_quoted(portable_text(name)), text_of(at));
  return list + ")";
}

}  // namespace

std::string panel_script(std::string_view stem, const FigureText& text, const FigureRange& x,
                         const std::vector<FigurePanel>& panels, const std::vector<std::string>& legend,
                         std::string_view extra, const FigureCanvas& given) {
  const FigureCanvas canvas = with_room(given, text);
  const double bottom = 130.0 + room_of_names(text);  // tics and label of the abscissa [pixels]
  constexpr double apart = 28;                        // half a label of a tic on both sides [pixels]
  constexpr double label_place = 40;
  double left = 0.0;  // one edge for all
  double parts = 0.0;
  for (const FigurePanel& panel : panels) {
    double width = tic_width(panel.y);
    for (const auto& [at, name] : panel.names) width = std::max(width, text_width(name) * font_height + 20.0);
    left = std::max(left, label_place + 45.0 + width);
    parts += panel.height;
  }
  const Head head = head_of(text, legend, canvas, std::max(usual_left, left));
  const auto vertical = [&](double pixels) { return text_of(1.0 - pixels / canvas.height); };
  const double heights = canvas.height - head.height - bottom - apart * static_cast<double>(panels.size() - 1);
  std::string commands = fmt::format(
      "set multiplot\n"
      "set lmargin screen {}\n"
      "set xrange [{}:{}]\n"
      "set format x ''\n",
      text_of(left / canvas.width), text_of(x.low), text_of(x.high));
  if (!text.x_names.empty()) commands += "set xtics rotate by 90 right " + named_tics(text.x_names) + "\n";
  double top = head.height;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const FigurePanel& panel = panels[k];
    const double height = heights * panel.height / parts;
    commands += fmt::format("set tmargin screen {}\nset bmargin screen {}\n", vertical(top), vertical(top + height));
    commands += fmt::format("set yrange [{}:{}]\n", text_of(panel.y.low), text_of(panel.y.high));
    commands += fmt::format("set label {} {} at screen {}, graph 0.5 center rotate by 90\n", label_tag,
                            gnuplot_quoted(portable_text(panel.y_label)), text_of(label_place / canvas.width));
    commands += more_digits("y", panel.y);
    if (panel.logarithmic) commands += logarithmic_axis("y", panel.y);
    if (!panel.names.empty()) commands += "set ytics " + named_tics(panel.names) + "\n";
    if (k == 0) commands += head.title + second_abscissa_of(text, x);
    if (k + 1 == panels.size())
      commands += fmt::format("set format x '%h'\n{}set xlabel {}\n", more_digits("x", x),
                              gnuplot_quoted(portable_text(text.x_label)));
    commands += fmt::format("plot {}\n", panel.plot);
    if (panel.logarithmic) commands += "unset logscale y\nset mytics 5\n";
    if (panel.logarithmic || !panel.names.empty()) commands += "set ytics autofreq\n";
    if (k == 0) commands += fmt::format("unset label {}\nunset key\n", title_tag);
    if (k == 0 && text.above) commands += "unset x2tics\nunset x2label\nset xtics mirror\n";
    top += height + apart;
  }
  return fmt::format("{}set rmargin screen {}\n{}{}{}", opening(stem), text_of(right_edge_of(text, x, canvas)),
                     head.settings, extra,
                     drawn_to_files(stem, commands + "unset multiplot\nset format x '%h'\nunset xlabel\n", canvas));
}

namespace {

/// The time of day in a PDF file: the same figure is the same bytes.
void forget_date(const fs::path& file) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  constexpr std::string_view tag = "/CreationDate (D:";
  constexpr std::string_view date = "20000101000000";
  const std::size_t at = bytes.rfind(tag);
  if (at == std::string::npos || at + tag.size() + date.size() > bytes.size()) return;
  stream.clear();
  stream.seekp(static_cast<std::streamoff>(at + tag.size()));
  stream << date;
}

}  // namespace

FigureOutcome draw_pictures(const fs::path& folder, std::string_view stem, Pictures which) {
  if (which == Pictures::none) return {};
  const auto named = [&](std::string_view suffix) { return folder / fmt::format("{}.{}", stem, suffix); };
  const FigureOutcome outcome = run_gnuplot(named("gp"), which);
  const auto take = [&](std::string_view suffix, std::string_view end) {
    const fs::path path = named(suffix);
    if (!outcome.drawn()) {
      std::error_code ignored;
      fs::remove(path, ignored);  // a part of it
      return report_placed(path, Placed::undrawn);
    }
    const FileDescriptor picture = open_descriptor(path, O_RDONLY);
    if (!ends_with(picture, path, end)) {
      throw OutputError(
          fmt::format("{}: gnuplot did not finish it (disk full?); make room and repeat the command", path.string()));
    }
    sync_descriptor(picture.get(), path);
    report_placed(path);
  };
  if (which == Pictures::png || which == Pictures::both) take(png, png_end);
  if (which == Pictures::svg || which == Pictures::both) take(svg, svg_end);
  if (which == Pictures::pdf) {
    if (outcome.drawn()) forget_date(named(pdf));
    take(pdf, pdf_end);
  }
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
  if (which != Pictures::none)  // else those that are drawn later are replaced, and others are kept
    for (const std::string_view suffix : {".png", ".svg"}) fs::remove(named(suffix), error);
  AtomicFile data(named(".dat"));
  write_data(data);
  data.commit();
  write_file_atomically(named(".gp"), script);
  return draw_pictures(folder, stem, which);
}

}  // namespace epicyclic::figures
