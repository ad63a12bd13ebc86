#include "parts.hpp"

#include <algorithm>

#include "host.hpp"
#include "stop.hpp"
#include "studies/parallel_for.hpp"

namespace epicyclic::app {

bool PartQueue::exhausted() const {
  return closed_ || std::ranges::none_of(states_, [](State s) { return s == State::waiting; });
}

std::optional<std::size_t> PartQueue::take_locked() {
  if (closed_) return std::nullopt;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const auto after = parts_[part].after;
    if (states_[part] != State::waiting || (after && states_.at(*after) != State::ended)) continue;
    states_[part] = State::begun;
    return part;
  }
  return std::nullopt;
}

std::optional<std::size_t> PartQueue::take() {
  std::unique_lock lock(mutex_);
  std::optional<std::size_t> part;
  changed_.wait(lock, [&] { return exhausted() || (part = take_locked()).has_value(); });
  return part;
}

std::optional<std::size_t> PartQueue::take_now() {
  const std::scoped_lock lock(mutex_);
  return take_locked();
}

void PartQueue::ended(std::size_t part) {
  const std::scoped_lock lock(mutex_);
  states_.at(part) = State::ended;
  changed_.notify_all();
}

void PartQueue::close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

void write_parts(const std::vector<ResultsPart>& parts, const ComputedPoints& computed, int threads, PartQueue& queue,
                 std::vector<WrittenPoints>& written) {
  const Host* waiting = host();  // for the end of this command, which has no other limit of time
  const auto most = std::min(parts.size(), static_cast<std::size_t>(std::max(1, threads)));
  studies::parallel_for(most, threads, nullptr, [&](std::size_t /*thread*/) {
    try {
      while (const auto part = queue.take()) {
        if (waiting != nullptr && waiting->stop) throw Stopped();
        written.at(*part) = parts[*part].write(computed);
        queue.ended(*part);
      }
    } catch (...) {
      queue.close();
      throw;
    }
  });
}

}  // namespace epicyclic::app
