#include "stop.hpp"

#include <cerrno>
#include <csignal>
#include <ctime>
#include <system_error>

#include <sys/syscall.h>
#include <unistd.h>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "host.hpp"

namespace epicyclic::app {

namespace {

std::atomic<bool> requested{false};
/// The message of a program that has to be ended, or nothing, and its code.
std::atomic<const char*> words_at_the_end{"stopped before the end; re-run the same command to resume\n"};
std::atomic<int> code_at_the_end{stopped_early};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
                  std::atomic<const char*>::is_always_lock_free,
              "the signal handlers may only touch lock-free atomics");

itimerspec once_after(std::chrono::milliseconds time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  itimerspec timer{};
  timer.it_value.tv_sec = seconds.count();
  timer.it_value.tv_nsec = std::chrono::nanoseconds(time - seconds).count();
  return timer;
}

/// Set before the handlers that use them are.
timer_t last_call;
itimerspec patience_left{};

// Signal handlers: async-signal-safe calls only.

void end_at_once(int /*signal*/) {
  if (const char* words = words_at_the_end) write_without_waiting(STDERR_FILENO, words);
  leave_at_once(code_at_the_end);
}

void request(int /*signal*/) {
  // Repeated signals do not put the end off.
  if (!requested.exchange(true)) ::timer_settime(last_call, 0, &patience_left, nullptr);
}

}  // namespace

const std::atomic<bool>& stop_requested() {
  const Host* of = host();
  return of != nullptr ? of->stop : requested;
}

void leave_at_once(int exit_code) noexcept {
  remove_unfinished_files();
  // The same as _exit() of the C library. ThreadSanitizer's _exit() reports threads that nobody waited for as an error,
  // and here they are left on purpose.
  ::syscall(SYS_exit_group, exit_code);
  __builtin_unreachable();
}

void give_up_if_stopped() {
  if (stop_requested()) throw Stopped();
}

void stop_on_signals(std::chrono::milliseconds until_the_end) {
  patience_left = once_after(until_the_end);
  sigevent alarm{};
  alarm.sigev_notify = SIGEV_SIGNAL;
  alarm.sigev_signo = SIGALRM;
  if (::timer_create(CLOCK_MONOTONIC, &alarm, &last_call) != 0)
    throw std::system_error(errno, std::generic_category(), "no timer");
  std::signal(SIGALRM, end_at_once);
  std::signal(SIGINT, request);
  std::signal(SIGTERM, request);
  if (std::signal(SIGHUP, request) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

void stop_soon(int exit_code, const char* last_words) {
  if (Host* of = host()) {  // its process goes on
    of->stop = true;
    return;
  }
  words_at_the_end = last_words;
  code_at_the_end = exit_code;
  request(0);
}

void leave_ranks(int exit_code) {
  words_at_the_end = nullptr;
  code_at_the_end = exit_code;
  const itimerspec left = once_after(patience_for_mpi);
  if (requested) ::timer_settime(last_call, 0, &left, nullptr);
}

}  // namespace epicyclic::app
