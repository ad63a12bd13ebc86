// An exception as the command line reports it: an exit code and one message.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace epicyclic::app {

/// An error that has its exit code already, as one of another rank.
class Failure : public std::runtime_error {
 public:
  Failure(int exit_code, const std::string& message) : std::runtime_error(message), exit_code_(exit_code) {}
  [[nodiscard]] int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

/// A lack of the machine, as is a full disk.
inline constexpr const char* out_of_memory =
    "out of memory or threads; what was written before is kept: make room or use fewer --threads, and repeat the "
    "command";

/// ExitCode of app/commands.hpp and message of any exception.
[[nodiscard]] Failure failure_of(const std::exception_ptr& error);

/// For std::set_terminate(): memory can end where nothing may be thrown, as in the start of a thread. That ends the
/// program as anywhere else; whatever else nobody has caught aborts it.
[[noreturn]] void end_uncaught();

}  // namespace epicyclic::app
