#include "streams.hpp"

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "host.hpp"

namespace epicyclic::app {

namespace {

/// Control characters but line feeds and tabs, of ASCII and of Latin-1 in UTF-8, are written as \u001b. A string of
/// JSON has the same meaning with them.
std::string printable(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const auto escape = [&safe](unsigned c) { safe += fmt::format("\\u{:04x}", c); };
  for (std::size_t k = 0; k < text.size(); ++k) {
    const unsigned c = byte(k);
    if ((c < 0x20 && c != '\n' && c != '\t') || c == 0x7F)
      escape(c);
    else if (c == 0xC2 && byte(k + 1) >= 0x80 && byte(k + 1) < 0xA0)  // U+0080 to U+009F
      escape(byte(++k));
    else
      safe += text[k];
  }
  return safe;
}

}  // namespace

void secure_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // A folder can be neither read nor written, so that a closed stream stays one. The lowest free number is taken.
    if (open_descriptor("/", O_RDONLY | O_DIRECTORY).release() != stream) ::_exit(output_failed);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void write_data(std::string_view text) {
  if (const Host* to = host()) {
    if (to->data) to->data(text);
    return;
  }
  write_all(STDOUT_FILENO, printable(text), "standard output");
}

void write_words(std::string_view text) noexcept {
  try {
    if (const Host* to = host()) {
      if (to->words) to->words(text);
      return;
    }
    write_all(STDERR_FILENO, printable(text), "standard error");
  } catch (...) {
    // No stream is left for a message.
  }
}

}  // namespace epicyclic::app
