// Functions that alternate on one thread, each on a stack of its own: while one waits, another runs.
//
// A fiber runs from resume() until it suspends itself or ends. So an algorithm that requests one evolution after
// another is written as if it were alone, and many of them keep the lanes of an integrator busy
// [integrate/lanes/lane_pool.hpp].
//
// Limits: a fiber stays on the thread that made it; its stack has 1 MiB, behind a page that cannot be touched, so that
// what outgrows it ends the program instead of spoiling another one's memory. Contexts are those of POSIX (ucontext.h);
// address and thread sanitizer get a call at each switch.
#pragma once

#include <functional>
#include <memory>

namespace epicyclic {

class Fiber {
 public:
  /// @throws std::bad_alloc if there is no memory for its stack
  explicit Fiber(std::function<void()> body);

  /// A body that is not over is unwound: its suspend() throws what only the fiber itself catches.
  ~Fiber();
  Fiber(const Fiber&) = delete;
  Fiber& operator=(const Fiber&) = delete;

  /// Goes on with the body until it suspends itself or is over. Not for a fiber that is over, nor from within itself.
  /// @throws what the body threw; it is over then
  void resume();

  [[nodiscard]] bool over() const;

  /// The one that the caller runs in, or nullptr.
  [[nodiscard]] static Fiber* current();

  /// Back to whoever resumed the current fiber, until it is resumed again.
  static void suspend();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace epicyclic
