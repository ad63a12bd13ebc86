#include "served_computation.hpp"

#include <exception>
#include <utility>

#include "command/failure.hpp"
#include "command/kind_commands.hpp"
#include "command/progress.hpp"
#include "command/stop.hpp"
#include "command/streams.hpp"

namespace epicyclic::app {

ServedComputation::ServedComputation() {
  host_.words = [](std::string_view text) {
    const HostScope program(nullptr);
    write_words(text);
  };
  host_.progress = [this](const std::string& /*label*/, const ProgressState& state) {
    done_ = state.done;
    total_ = state.total;
  };
}

bool ServedComputation::end() {
  server_ended_ = true;
  cancel();
  if (thread_.joinable()) thread_.join();
  return stopped_at_the_end_;
}

bool ServedComputation::start(Job job) {
  const std::scoped_lock lock(mutex_);
  if (busy_ || stop_requested()) return false;
  if (thread_.joinable()) thread_.join();  // it has ended
  busy_ = true;
  study_ = job.study;
  done_ = 0;
  total_ = 0;
  host_.stop = false;
  begun_ = std::chrono::steady_clock::now();
  thread_ = std::thread([this, of = std::move(job)] { run(of); });
  return true;
}

void ServedComputation::run(const Job& job) {
  int code = bug;
  std::string message;
  try {
    Arguments arguments = job.arguments;
    arguments.quiet = true;
    const HostScope scope(&host_);
    code = command_of(job.kind).run(arguments);
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    code = failure.exit_code();
    message = failure.what();
    print_message("{}\n", failure.what());
  }
  const std::scoped_lock lock(mutex_);
  stopped_at_the_end_ = server_ended_ && code == stopped_early;
  busy_ = false;
  last_ = {{"study", job.study}, {"code", code}, {"message", message}};
  ended_.notify_all();
}

void ServedComputation::cancel() {
  const std::scoped_lock lock(mutex_);
  if (busy_) host_.stop = true;
}

bool ServedComputation::wait(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  return ended_.wait_for(lock, most, [this] { return !busy_; });
}

bool ServedComputation::busy() const {
  const std::scoped_lock lock(mutex_);
  return busy_;
}

nlohmann::json ServedComputation::current() const {
  const std::scoped_lock lock(mutex_);
  if (!busy_) return nullptr;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun_;
  return {{"study", study_}, {"done", done_.load()}, {"total", total_.load()}, {"seconds", spent.count()}};
}

nlohmann::json ServedComputation::last() const {
  const std::scoped_lock lock(mutex_);
  return last_;
}

}  // namespace epicyclic::app
