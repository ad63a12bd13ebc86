#include "streams.hpp"

#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <unistd.h>

#include "commands.hpp"
#include "core/atomic_file.hpp"

namespace epicyclic::app {

void secure_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // A folder can be neither read nor written, so that a closed stream stays one. The lowest free number is taken.
    if (open_descriptor("/", O_RDONLY | O_DIRECTORY).release() != stream) ::_exit(output_failed);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void write_data(std::string_view text) { write_all(STDOUT_FILENO, text, "standard output"); }

void write_words(std::string_view text) noexcept {
  try {
    write_all(STDERR_FILENO, text, "standard error");
  } catch (...) {
    // There is nobody to tell.
  }
}

}  // namespace epicyclic::app
