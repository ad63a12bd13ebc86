#include "core/fiber.hpp"

#include <cstddef>
#include <exception>
#include <new>
#include <utility>

#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define EPICYCLIC_ADDRESS_SANITIZER
#endif
#if __has_feature(thread_sanitizer)
#define EPICYCLIC_THREAD_SANITIZER
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define EPICYCLIC_ADDRESS_SANITIZER
#endif
#ifdef __SANITIZE_THREAD__
#define EPICYCLIC_THREAD_SANITIZER
#endif
#ifdef EPICYCLIC_ADDRESS_SANITIZER
#include <sanitizer/common_interface_defs.h>
#endif
#ifdef EPICYCLIC_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace epicyclic {

namespace {

constexpr std::size_t stack_bytes = std::size_t{1} << 20;

/// Pages that are there once they are touched, behind one that cannot be.
class Stack {
 public:
  Stack() : guard_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) {
    memory_ = mmap(nullptr, guard_ + stack_bytes, PROT_READ | PROT_WRITE,
                   MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    if (mprotect(memory_, guard_, PROT_NONE) == 0) return;
    munmap(memory_, guard_ + stack_bytes);
    throw std::bad_alloc();
  }
  ~Stack() { munmap(memory_, guard_ + stack_bytes); }
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;

  [[nodiscard]] void* bottom() const { return static_cast<std::byte*>(memory_) + guard_; }

 private:
  std::size_t guard_;
  void* memory_ = nullptr;
};

/// Unwinds a body that nobody waits for any more. Not an std::exception: nobody else is to catch it.
struct Unwound {};

}  // namespace

class Fiber::Impl {
 public:
  Impl(Fiber* self, std::function<void()> body) : self_(self), body_(std::move(body)) {
    getcontext(&own_);
    own_.uc_stack.ss_sp = stack_.bottom();
    own_.uc_stack.ss_size = stack_bytes;
    own_.uc_link = nullptr;
    makecontext(&own_, &Impl::enter, 0);
#ifdef EPICYCLIC_THREAD_SANITIZER
    own_fiber_ = __tsan_create_fiber(0);
#endif
  }
  ~Impl() {
    if (begun_ && !over_) {
      unwind_ = true;
      go_on();
    }
#ifdef EPICYCLIC_THREAD_SANITIZER
    __tsan_destroy_fiber(own_fiber_);
#endif
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void resume() {
    go_on();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

  /// In the fiber.
  void suspend() {
    leave(false);
    if (unwind_) throw Unwound();
  }

  [[nodiscard]] bool over() const { return over_; }

  static inline thread_local Impl* current = nullptr;
  Fiber* self_;

 private:
  void go_on() {
    before_ = std::exchange(current, this);
    begun_ = true;
#ifdef EPICYCLIC_ADDRESS_SANITIZER
    void* fake_stack = nullptr;
    __sanitizer_start_switch_fiber(&fake_stack, stack_.bottom(), stack_bytes);
#endif
#ifdef EPICYCLIC_THREAD_SANITIZER
    caller_fiber_ = __tsan_get_current_fiber();
    __tsan_switch_to_fiber(own_fiber_, 0);
#endif
    swapcontext(&caller_, &own_);
#ifdef EPICYCLIC_ADDRESS_SANITIZER
    __sanitizer_finish_switch_fiber(fake_stack, nullptr, nullptr);
#endif
    current = before_;
  }

  /// Back to the caller.
  void leave([[maybe_unused]] bool for_good) {
#ifdef EPICYCLIC_ADDRESS_SANITIZER
    void* fake_stack = nullptr;
    __sanitizer_start_switch_fiber(for_good ? nullptr : &fake_stack, caller_bottom_, caller_bytes_);
#endif
#ifdef EPICYCLIC_THREAD_SANITIZER
    __tsan_switch_to_fiber(caller_fiber_, 0);
#endif
    swapcontext(&own_, &caller_);
#ifdef EPICYCLIC_ADDRESS_SANITIZER
    __sanitizer_finish_switch_fiber(fake_stack, &caller_bottom_, &caller_bytes_);
#endif
  }

  static void enter() { current->run(); }

  void run() {
#ifdef EPICYCLIC_ADDRESS_SANITIZER
    __sanitizer_finish_switch_fiber(nullptr, &caller_bottom_, &caller_bytes_);
#endif
    try {
      body_();
    } catch (const Unwound&) {
      // As it was meant to.
    } catch (...) {
      failure_ = std::current_exception();
    }
    over_ = true;
    leave(true);
  }

  std::function<void()> body_;
  Stack stack_;
  ucontext_t own_{}, caller_{};
  Impl* before_ = nullptr;  ///< fiber that resumed this one
  bool begun_ = false;
  bool over_ = false;
  bool unwind_ = false;
  std::exception_ptr failure_;
#ifdef EPICYCLIC_ADDRESS_SANITIZER
  const void* caller_bottom_ = nullptr;
  std::size_t caller_bytes_ = 0;
#endif
#ifdef EPICYCLIC_THREAD_SANITIZER
  void* own_fiber_ = nullptr;
  void* caller_fiber_ = nullptr;
#endif
};

Fiber::Fiber(std::function<void()> body) : impl_(std::make_unique<Impl>(this, std::move(body))) {}
Fiber::~Fiber() = default;

void Fiber::resume() { impl_->resume(); }
bool Fiber::over() const { return impl_->over(); }
Fiber* Fiber::current() { return Impl::current == nullptr ? nullptr : Impl::current->self_; }
void Fiber::suspend() { Impl::current->suspend(); }

}  // namespace epicyclic
