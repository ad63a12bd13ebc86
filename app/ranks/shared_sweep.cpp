#include "shared_sweep.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "failure.hpp"
#include "folder.hpp"
#include "input/study_model.hpp"
#include "messages.hpp"
#include "ranks.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "store/journal.hpp"
#include "store/manifest.hpp"
#include "store/point_record.hpp"
#include "store/point_store.hpp"

namespace epicyclic::app {

namespace {

using nlohmann::json;
constexpr std::chrono::milliseconds progress_interval{100};
/// The unfinished chains, in order. Both arguments must live longer.
class OpenChains {
 public:
  OpenChains(const studies::SweepPlan& plan, const std::vector<bool>& done) : plan_(plan), done_(done) {
    for (std::size_t chain = 0; chain < plan.chains.size(); ++chain) left_ += is_open(chain) ? 1 : 0;
  }

  std::optional<std::size_t> take() {
    const std::scoped_lock lock(mutex_);
    if (left_ == 0) return std::nullopt;
    return next();
  }

  /// For a rank that has no more: a part of the remaining chains. It shrinks towards the end, so that many small chains
  /// cost few messages and all ranks end at the same time.
  std::vector<Index> take_some(int threads_of_all) {
    constexpr std::size_t most = 1000;
    const std::scoped_lock lock(mutex_);
    const std::size_t share = left_ / (4 * static_cast<std::size_t>(std::max(1, threads_of_all)));
    std::vector<Index> some(std::min(left_, std::clamp<std::size_t>(share, 1, most)));
    for (Index& chain : some) chain = next();
    return some;
  }

 private:
  [[nodiscard]] bool is_open(std::size_t chain) const {
    for (const std::size_t point : plan_.chains[chain])
      if (!done_[point]) return true;
    return false;
  }

  /// While there are some left.
  std::size_t next() {
    while (!is_open(next_)) ++next_;
    --left_;
    return next_++;
  }

  const studies::SweepPlan& plan_;
  const std::vector<bool>& done_;
  std::size_t left_ = 0;
  std::size_t next_ = 0;
  std::mutex mutex_;
};

/// Flags as hexadecimal digits, four in each, for a message.
std::string text_of_flags(const std::vector<bool>& flags) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  text.reserve((flags.size() + 3) / 4);
  for (std::size_t first = 0; first < flags.size(); first += 4) {
    std::size_t digit = 0;
    for (std::size_t k = first; k < std::min(first + 4, flags.size()); ++k)
      digit |= std::size_t{flags[k]} << (k - first);
    text += digits[digit];
  }
  return text;
}

/// @param size  how many they are
std::vector<bool> flags_in(std::string_view text, std::size_t size) {
  std::vector<bool> flags(size);
  for (std::size_t k = 0; k < size; ++k) {
    const char digit = text.at(k / 4);
    flags[k] = (((digit <= '9' ? digit - '0' : digit - 'a' + 10) >> (k % 4)) & 1) != 0;
  }
  return flags;
}

json written_to(const WrittenPoints& written) {
  json figures = json::array();
  for (const reports::DrawnFigure& figure : written.figures)
    figures.push_back({{"file", figure.file.string()}, {"message", figure.outcome.message}});
  return {{"figures", figures},
          {"summary", written.summary},
          {"lines", written.lines},
          {"notes", written.notes},
          {"files", store::to_json(written.files)}};
}

WrittenPoints written_from(const json& report) {
  WrittenPoints written;
  for (const json& figure : report.at("figures"))
    written.figures.push_back({figure.at("file").get<std::string>(), {figure.at("message").get<std::string>()}});
  written.summary = report.at("summary");
  written.lines = report.at("lines").get<std::vector<std::string>>();
  written.notes = report.at("notes").get<std::vector<std::string>>();
  written.files = store::manifest_from(report.at("files")).value();
  return written;
}

/// The requests and reports of the ranks of a sweep, and their results. All arguments must live longer.
class RankAnswers {
 public:
  RankAnswers(Ranks& ranks, OpenChains& chains, const std::function<std::vector<double>(std::size_t point)>& end_state,
              int threads_of_all, const std::function<void(std::size_t, std::size_t)>& points_elsewhere)
      : ranks_(ranks),
        chains_(chains),
        end_state_(end_state),
        threads_of_all_(threads_of_all),
        points_elsewhere_(points_elsewhere),
        through_(static_cast<std::size_t>(ranks.size()), false) {
    through_[0] = true;
  }

  [[nodiscard]] bool all_through() const {
    return std::ranges::all_of(through_, [](bool b) { return b; });
  }
  [[nodiscard]] bool stop_wanted() const { return stop_wanted_; }
  /// The first one, of a rank or of an answer.
  [[nodiscard]] const std::optional<Failure>& failure() const { return failure_; }

  void give(const Message& message) {
    try {
      answer(message);
    } catch (...) {
      if (!failure_) failure_ = failure_of(std::current_exception());
    }
  }

 private:
  void answer(const Message& message) {
    switch (message.topic) {
      case Topic::request_chains:
        ranks_.send(message.from, Topic::chains, bytes_of(chains_.take_some(threads_of_all_)));
        break;
      case Topic::request_end_state: {
        const Index point = values_of<Index>(message.bytes).at(0);
        const std::string head = bytes_of(std::vector<Index>{point});
        ranks_.send(message.from, Topic::end_state, head + bytes_of(end_state_(static_cast<std::size_t>(point))));
        break;
      }
      case Topic::progress: {
        const auto counts = values_of<Index>(message.bytes);
        points_elsewhere_(static_cast<std::size_t>(counts.at(0)), static_cast<std::size_t>(counts.at(1)));
        break;
      }
      case Topic::stop:
        stop_wanted_ = true;
        break;
      case Topic::finished:
        through_[static_cast<std::size_t>(message.from)] = true;
        if (!failure_) failure_ = failure_in(json::parse(message.bytes));
        break;
      default:
        break;
    }
  }

  Ranks& ranks_;
  OpenChains& chains_;
  const std::function<std::vector<double>(std::size_t point)>& end_state_;
  int threads_of_all_;
  const std::function<void(std::size_t, std::size_t)>& points_elsewhere_;
  std::vector<bool> through_;  ///< of each rank
  bool stop_wanted_ = false;
  std::optional<Failure> failure_;
};

}  // namespace

void SweepLeader::gather(const Arguments& arguments, const std::string& identity) {
  const std::vector<int> threads = muster(arguments, identity);
  threads_of_all_ = std::accumulate(threads.begin(), threads.end(), 0);
}

void SweepLeader::run(const studies::SweepPlan& plan, const studies::RecordingOptions& recording,
                      const integrate::IntegratorOptions& integrator, const studies::ModelAtPoint& model_at,
                      studies::SweepRun run, const std::function<void(std::size_t, std::size_t)>& points_elsewhere) {
  const std::atomic<bool>& signal = *run.stop;
  std::atomic<bool> stop{false};
  OpenChains chains(plan, run.done);
  run.stop = &stop;
  run.next_chain = [&chains] { return chains.take(); };
  run.threads_of_all = threads_of_all_;

  const std::string begin = text_of({{"threads_of_all", threads_of_all_}, {"done", text_of_flags(run.done)}});
  for (int rank = 1; rank < ranks_.size(); ++rank) ranks_.send(rank, Topic::begin, begin);

  Computation computation([&] { (void)studies::run_sweep(plan, recording, integrator, model_at, run); }, stop);
  bool computed = false;
  Attention attention;
  RankAnswers answers(ranks_, chains, run.end_state, threads_of_all_, points_elsewhere);
  std::optional<Clock::time_point> stopped;
  while (!computed || !answers.all_through()) {
    const auto message = ranks_.receive();
    if (message) {
      if (message->topic != Topic::progress) attention.rouse();
      answers.give(*message);
    }
    if (!stopped && (signal || answers.stop_wanted() || answers.failure() || (computed && computation.failed()))) {
      stop = true;
      stopped = Clock::now();
      attention.rouse();
      for (int rank = 1; rank < ranks_.size(); ++rank) ranks_.send(rank, Topic::stop, {});
    }
    if (computed && stopped && Clock::now() - *stopped > farewell) {
      silent_ = true;
      break;
    }
    if (message) continue;
    if (computed)
      std::this_thread::sleep_for(poll_interval);  // on a core that has nothing else to do
    else
      computed = computation.ends_within(attention.pause());
  }
  computation.join();
  if (answers.failure()) throw *answers.failure();
  if (silent_) throw Failure(stopped_early, "a rank does not answer; re-run the same command to resume");
}

std::vector<WrittenPoints> SweepLeader::write(const std::vector<ResultsPart>& parts, const ComputedPoints& computed,
                                              int threads) {
  std::vector<WrittenPoints> written(parts.size());
  PartQueue queue(parts);
  std::exception_ptr error;
  std::atomic<bool> through{false};
  // Joined on every exit from this function.
  std::jthread worker([&] {
    try {
      write_parts(parts, computed, threads, queue, written);
    } catch (...) {
      error = std::current_exception();
    }
    through = true;
  });

  std::optional<Failure> failure;
  // Parts that each rank writes. The remaining parts may have to wait for one that another rank writes.
  std::vector<std::optional<std::size_t>> elsewhere(static_cast<std::size_t>(ranks_.size()));
  const auto give = [&] {
    for (std::size_t rank = 1; rank < elsewhere.size(); ++rank) {
      if (elsewhere[rank] || !(elsewhere[rank] = queue.take_now())) continue;
      ranks_.send(static_cast<int>(rank), Topic::write, bytes_of(std::vector<Index>{*elsewhere[rank]}));
    }
  };
  const auto any_elsewhere = [&] { return std::ranges::any_of(elsewhere, [](auto part) { return part.has_value(); }); };
  for (give(); !through || any_elsewhere(); give()) {
    const auto message = ranks_.receive();
    if (!message) {
      std::this_thread::sleep_for(poll_interval);
    } else if (message->topic == Topic::written) {
      const json report = json::parse(message->bytes);
      const auto part = elsewhere.at(static_cast<std::size_t>(message->from)).value();
      elsewhere[static_cast<std::size_t>(message->from)].reset();
      if (const auto failed = failure_in(report)) {
        if (!failure) failure = failed;
        queue.close();
      } else {
        written[part] = written_from(report);
      }
      queue.ended(part);
    }
  }
  worker.join();
  if (error) std::rethrow_exception(error);
  if (failure) throw *failure;
  return written;
}

void SweepLeader::dismiss(int exit_code) {
  if (silent_) ranks_.abort(exit_code);
  let_go(ranks_, exit_code);
}

namespace {

/// Requests of a rank's threads, and the messages that it receives.
class Exchange {
 public:
  explicit Exchange(Ranks& ranks) : ranks_(ranks) {}

  [[nodiscard]] const std::atomic<bool>& stop() const { return stop_; }

  // For the threads that compute.

  std::optional<std::size_t> next_chain() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    wake_.notify_all();  // it checks the rest once this releases the lock
    answered_.wait(lock, [this] { return stop_ || no_more_ || !chains_.empty(); });
    --waiting_;
    if (stop_ || chains_.empty()) return std::nullopt;
    const auto chain = static_cast<std::size_t>(chains_.front());
    chains_.pop_front();
    return chain;
  }

  std::vector<double> end_state(std::size_t point) {
    std::unique_lock lock(mutex_);
    questions_.push_back(point);
    wake_.notify_all();
    answered_.wait(lock, [&] { return stop_ || end_states_.contains(point); });
    const auto answer = end_states_.extract(point);
    return answer.empty() ? std::vector<double>{} : answer.mapped();
  }

  void count(bool failed) {
    const std::scoped_lock lock(mutex_);
    ++finished_;
    failed_ += failed ? 1 : 0;
  }

  void threads_are_through() {
    const std::scoped_lock lock(mutex_);
    through_ = true;
    wake_.notify_all();
  }

  // For the thread of the messages.

  /// Until the threads are through.
  void serve() {
    bool stop_sent = false;
    auto last_progress = Clock::now();
    for (;;) {
      while (const auto message = ranks_.receive()) {
        attention_.rouse();
        take(*message);
      }
      if (stop_requested() && !std::exchange(stop_sent, true)) ranks_.send(0, Topic::stop, {});
      std::unique_lock lock(mutex_);
      if (through_) break;
      if (wants_chains()) {
        requested_ = true;
        request(Topic::request_chains, {});
      }
      for (const Index point : std::exchange(questions_, {}))
        request(Topic::request_end_state, bytes_of(std::vector<Index>{point}));
      if (Clock::now() - last_progress >= progress_interval) {
        last_progress = Clock::now();
        report_progress();
      }
      wake_.wait_for(lock, attention_.pause(), [this] { return through_ || wants_chains() || !questions_.empty(); });
    }
    const std::scoped_lock lock(mutex_);
    report_progress();
  }

 private:
  /// While many are left, the next ones are requested before a thread has to wait for them.
  [[nodiscard]] bool wants_chains() const {
    return chains_.empty() && (waiting_ > 0 || many_left_) && !requested_ && !no_more_ && !stop_;
  }

  void request(Topic topic, std::string bytes) {
    attention_.rouse();
    ranks_.send(0, topic, std::move(bytes));
  }

  void take(const Message& message) {
    const std::scoped_lock lock(mutex_);
    if (message.topic == Topic::chains) {
      const auto chains = values_of<Index>(message.bytes);
      chains_.insert(chains_.end(), chains.begin(), chains.end());
      no_more_ = chains.empty();
      many_left_ = chains.size() > 1;
      requested_ = false;
    } else if (message.topic == Topic::end_state) {
      const Index point = values_of<Index>(message.bytes.substr(0, sizeof(Index))).at(0);
      end_states_[point] = values_of<double>(message.bytes.substr(sizeof(Index)));
    } else if (message.topic == Topic::stop) {
      stop_ = true;
    }
    answered_.notify_all();
  }

  void report_progress() {
    if (finished_ == 0) return;
    ranks_.send(0, Topic::progress, bytes_of(std::vector<Index>{finished_, failed_}));
    finished_ = failed_ = 0;
  }

  Ranks& ranks_;
  std::mutex mutex_;
  std::condition_variable wake_, answered_;
  std::atomic<bool> stop_{false};
  std::deque<Index> chains_;
  bool requested_ = false, no_more_ = false, many_left_ = false, through_ = false;
  int waiting_ = 0;
  Attention attention_;
  std::vector<Index> questions_;
  std::map<Index, std::vector<double>> end_states_;
  Index finished_ = 0, failed_ = 0;
};

/// Computes the chains that the leader assigns.
void compute_share(const Arguments& arguments, const input::LoadedInput& input, const std::string& identity,
                   const json& begin) {
  const studies::RecordingOptions& recording = input.study.recording();
  const studies::SweepPlan plan = input::plan_of(input.study);
  store::Journal journal(arguments.output / store::rank_journal_name(arguments.ranks->rank()), identity);
  Exchange exchange(*arguments.ranks);
  studies::SweepRun run;
  run.threads = arguments.threads;
  run.threads_of_all = begin.at("threads_of_all").get<int>();
  run.process = static_cast<std::size_t>(arguments.ranks->rank());
  run.stop = &exchange.stop();
  run.done = flags_in(begin.at("done").get_ref<const std::string&>(), plan.points.size());
  run.end_state = [&](std::size_t point) { return exchange.end_state(point); };
  run.next_chain = [&] { return exchange.next_chain(); };
  run.point_finished = [&](const studies::PointResult& result) {
    journal.append(result.point.index, store::encode_point(result));
    exchange.count(result.outcome != integrate::Outcome::reached);
  };
  std::exception_ptr error;
  std::thread worker([&] {
    try {
      (void)studies::run_sweep(plan, recording, input.study.integrator, input::model_at_point(input), run);
      journal.close();
    } catch (...) {
      error = std::current_exception();
    }
    exchange.threads_are_through();
  });
  exchange.serve();
  worker.join();
  if (error) std::rethrow_exception(error);
}

/// Data of a rank for writing its parts: the journals of all ranks, opened when the first part is assigned.
class PartWriter {
 public:
  PartWriter(const Arguments& arguments, const input::LoadedInput& input, const std::string& identity)
      : folder_(arguments.output),
        input_(input),
        plan_(input::plan_of(input.study)),
        first_model_(input::model_at_point(input)(plan_.points.front())),
        resolved_(resolved_text(input)),
        store_(folder_, identity, plan_.points.size(), store::Journal::Use::read) {}

  [[nodiscard]] json write(const ResultsPart& part) const {
    const store::FileRecorder recorder(folder_);
    WrittenPoints written = part.write({folder_, input_, first_model_, resolved_, store_.source()});
    written.files = recorder.files();
    return written_to(written);
  }

 private:
  const std::filesystem::path& folder_;
  const input::LoadedInput& input_;
  const studies::SweepPlan plan_;
  const model::DynamicModel first_model_;
  const std::string resolved_;
  const store::PointStore store_;
};

}  // namespace

int follow(const Arguments& arguments, std::string_view command, const std::vector<ResultsPart>& parts) {
  Ranks& ranks = *arguments.ranks;
  std::optional<input::LoadedInput> input;
  std::optional<PartWriter> writer;
  std::string identity;
  std::exception_ptr error;
  try {
    input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
    identity = identity_of(*input, command);
  } catch (...) {
    error = std::current_exception();
  }
  say_hello(arguments, identity, error);
  for (Attention attention;;) {
    const auto message = ranks.receive();
    if (message && message->topic == Topic::leave) return static_cast<int>(values_of<Index>(message->bytes).at(0));
    if (message && message->topic == Topic::begin) {
      error = nullptr;
      try {
        compute_share(arguments, *input, identity, json::parse(message->bytes));
      } catch (...) {
        error = std::current_exception();
      }
      ranks.send(0, Topic::finished, text_of(report_of(ranks, error)));
    }
    if (message && message->topic == Topic::write) {
      const Index part = values_of<Index>(message->bytes).at(0);
      json written = json::object();
      error = nullptr;
      try {
        if (!writer) writer.emplace(arguments, *input, identity);
        written = writer->write(parts.at(static_cast<std::size_t>(part)));
      } catch (...) {
        error = std::current_exception();
      }
      json report = report_of(ranks, error);
      report.update(written);
      ranks.send(0, Topic::written, text_of(report));
    }
    if (message)
      attention.rouse();
    else
      std::this_thread::sleep_for(attention.pause());
  }
}

}  // namespace epicyclic::app
