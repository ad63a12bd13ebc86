// SIGINT, SIGTERM and SIGHUP: stop soon, resumable.
//
// The first of these signals sets a flag. The study then abandons the points in progress, leaves its folder in order
// and ends with code 75, commonly within milliseconds. Work that does not check the flag for a second is ended there
// with the same code: a mesh period that takes minutes, the writing of large results. A folder is sound at any moment,
// as after kill -9. So this loses nothing but the state "stopped" in run.json. The temporary files of this process are
// removed: those of `plot` and `assert` stand in folders that no later session tidies.
//
// main() installs the handlers for each command that writes, before it begins. The signal itself ends a command that
// writes nothing.
//
// The host of a command [host.hpp] stops it in place of a signal. So stop_requested() has to be called on the thread of
// the command. Its other threads read the reference.
//
// Ranks have one second for all of it. Open MPI's mpirun passes a SIGTERM or SIGINT on after a second. From then on it
// answers no rank, so that MPI's own end waits for nothing. It kills the ranks a second later.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>

namespace epicyclic::app {

/// Set by the first SIGINT, SIGTERM or SIGHUP after stop_on_signals(), or by the host of the command.
[[nodiscard]] const std::atomic<bool>& stop_requested();

/// Work in progress was abandoned because of stop_requested(). The code that has a folder open catches this exception
/// and leaves the folder in order. Anywhere else it ends the command with code 75 [failure_of()].
class Stopped : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "stopped; re-run the same command to resume"; }
};

/// @throws Stopped if a stop is requested
void give_up_if_stopped();

/// Half of the two seconds within which the program promises to end; what ranks have to put the folder in order, and
/// then for MPI's end.
constexpr std::chrono::milliseconds patience{1000};
constexpr std::chrono::milliseconds patience_of_ranks{650};
constexpr std::chrono::milliseconds patience_for_mpi{300};

/// Ends the program without waiting for its threads; removes its temporary files. Async-signal-safe.
[[noreturn]] void leave_at_once(int exit_code) noexcept;

/// To be called once, before anything is written. SIGHUP stays ignored where it is, as under nohup.
void stop_on_signals(std::chrono::milliseconds until_the_end = patience);

/// As by a signal; of a command with a host without an end of the program. If the program has to be ended, it ends with
/// this message and this code.
/// @param last_words  a string with static lifetime
void stop_soon(int exit_code, const char* last_words);

/// For a rank that has written and said everything: if a signal has come, the program ends after patience_for_mpi at
/// the latest; then, and if one comes now, without a word and with this code.
void leave_ranks(int exit_code);

}  // namespace epicyclic::app
