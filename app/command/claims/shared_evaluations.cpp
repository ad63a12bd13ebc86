#include "shared_evaluations.hpp"

#include <algorithm>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "claims/candidate_record.hpp"
#include "claims/kind.hpp"
#include "ranks/messages.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

using claims::EvaluatedCandidate;
using claims::Evaluation;
using nlohmann::json;

/// A candidate to be evaluated, as a message: number, how, bound, place.
struct SentQuestion {
  Index number = 0;
  Index whole = 0;
  double give_up_at = 0;
  std::vector<double> u;

  [[nodiscard]] std::string bytes() const {
    return bytes_of(std::vector<Index>{number, whole}) + bytes_of(std::vector<double>{give_up_at}) + bytes_of(u);
  }
  [[nodiscard]] static SentQuestion from(const std::string& bytes) {
    SentQuestion q;
    const std::vector<Index> head = values_of<Index>(bytes.substr(0, 2 * sizeof(Index)));
    q.number = head.at(0);
    q.whole = head.at(1);
    std::vector<double> numbers = values_of<double>(bytes.substr(2 * sizeof(Index)));
    q.give_up_at = numbers.at(0);
    q.u.assign(numbers.begin() + 1, numbers.end());
    return q;
  }
};

/// An answer, as a message: the number, then the record of the journal.
std::string answer_bytes(Index number, const Evaluation& evaluation) {
  const std::vector<std::byte> record = claims::encode_candidate({{}, {}, evaluation});
  return bytes_of(std::vector<Index>{number}) +
         std::string(reinterpret_cast<const char*>(record.data()), record.size());
}
std::pair<Index, Evaluation> answer_from(const std::string& bytes) {
  const Index number = values_of<Index>(bytes.substr(0, sizeof(Index))).at(0);
  const auto* record = reinterpret_cast<const std::byte*>(bytes.data() + sizeof(Index));
  return {number, claims::decode_candidate({record, bytes.size() - sizeof(Index)}).evaluation};
}

/// Places for the evaluation of a candidate: threads here, and threads of other ranks.
class Places {
 public:
  Places(const claims::Evaluator& here, const std::vector<int>& threads) : here_(here) {
    for (std::size_t rank = threads.size(); rank-- > 0;)
      for (int k = 0; k < threads[rank]; ++k) free_.push_back(static_cast<int>(rank));
  }

  // For the threads that work.

  Evaluation evaluate(const claims::Question& question) {
    std::unique_lock lock(mutex_);
    freed_.wait(lock, [&] { return over_ || !free_.empty(); });
    throw_if_over();
    const int rank = free_.back();  // those here first
    free_.pop_back();
    std::optional<Evaluation> evaluation;
    try {
      evaluation = rank == 0 ? evaluate_here(question, lock) : evaluate_there(rank, question, lock);
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      free_.push_back(rank);
      freed_.notify_all();
      throw;
    }
    free_.push_back(rank);
    freed_.notify_all();
    return *std::move(evaluation);
  }

  // For the thread of the messages.

  /// Messages to be sent, with their receivers.
  [[nodiscard]] std::vector<std::pair<int, SentQuestion>> take_questions() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(questions_, {});
  }

  void take(Index number, Evaluation evaluation) {
    const std::scoped_lock lock(mutex_);
    answers_[number] = std::move(evaluation);
    answered_.notify_all();
  }

  /// Releases all waiting threads.
  void end(std::optional<Failure> failure) {
    const std::scoped_lock lock(mutex_);
    over_ = true;
    if (!failure_) failure_ = std::move(failure);
    freed_.notify_all();
    answered_.notify_all();
  }

 private:
  void throw_if_over() const {
    if (!over_) return;
    if (failure_) throw *failure_;
    throw claims::EvaluationStopped();
  }

  Evaluation evaluate_here(claims::Question question, std::unique_lock<std::mutex>& lock) {
    question.thread = local_++;
    lock.unlock();
    Evaluation evaluation = here_(question);
    lock.lock();
    return evaluation;
  }

  Evaluation evaluate_there(int rank, const claims::Question& q, std::unique_lock<std::mutex>& lock) {
    const Index number = next_++;
    questions_.emplace_back(rank, SentQuestion{number, q.whole ? 1U : 0U, q.give_up_at, {q.u.begin(), q.u.end()}});
    answered_.wait(lock, [&] { return over_ || answers_.contains(number); });
    auto answer = answers_.extract(number);
    if (answer.empty()) throw_if_over();
    return std::move(answer.mapped());
  }

  const claims::Evaluator& here_;
  std::mutex mutex_;
  std::condition_variable freed_, answered_;
  std::vector<int> free_;  ///< ranks of free places; those here last
  std::size_t local_ = 0;
  Index next_ = 0;
  std::vector<std::pair<int, SentQuestion>> questions_;
  std::map<Index, Evaluation> answers_;
  bool over_ = false;
  std::optional<Failure> failure_;
};

}  // namespace

void SharedEvaluations::gather(const std::string& identity) {
  threads_ = arguments_.ranks->size() == 1 ? std::vector{arguments_.threads} : muster(arguments_, identity);
}

const std::atomic<bool>& SharedEvaluations::stop() const {
  return arguments_.ranks->size() == 1 ? stop_requested() : stop_;
}

void SharedEvaluations::run(const claims::Evaluator& here,
                            const std::function<void(const claims::Evaluator& evaluate, int threads)>& work) {
  Ranks& ranks = *arguments_.ranks;
  if (ranks.size() == 1) return work(here, arguments_.threads);
  Places places(here, threads_);
  const claims::Evaluator shared = [&](const claims::Question& question) { return places.evaluate(question); };
  Computation computation([&] { work(shared, std::accumulate(threads_.begin(), threads_.end(), 0)); }, stop_);
  Attention attention;
  bool stop_sent = false;
  const auto stop_others = [&] {
    if (std::exchange(stop_sent, true)) return;
    for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, Topic::stop, {});
  };
  for (bool ended = false; !ended;) {
    while (const auto message = ranks.receive()) {
      attention.rouse();
      if (message->topic == Topic::evaluated) {
        auto [number, evaluation] = answer_from(message->bytes);
        places.take(number, std::move(evaluation));
      } else if (message->topic == Topic::finished) {
        if (auto failure = failure_in(json::parse(message->bytes))) places.end(std::move(failure));
      } else if (message->topic == Topic::stop) {
        stop_ = true;
      }
    }
    for (const auto& [rank, question] : places.take_questions()) {
      attention.rouse();
      ranks.send(rank, Topic::evaluate, question.bytes());
    }
    if (stop_ || stop_requested()) {
      stop_ = true;
      stop_others();
      places.end({});
    }
    ended = computation.ends_within(attention.pause());
  }
  stop_others();
  computation.join();
}

namespace {

/// A rank other than the first: its threads evaluate the candidates of its messages.
class Follower {
 public:
  Follower(Ranks& ranks, const claims::Evaluator& evaluate, int threads, std::atomic<bool>& stop)
      : ranks_(ranks), evaluate_(evaluate), stop_(stop) {
    for (int k = 0; k < threads; ++k) threads_.emplace_back([this, k] { work(static_cast<std::size_t>(k)); });
  }
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;
  ~Follower() { end(); }

  void take(SentQuestion question) {
    const std::scoped_lock lock(mutex_);
    questions_.push_back(std::move(question));
    wake_.notify_one();
  }

  /// Sends the finished results.
  void send_answers() {
    std::vector<std::string> answers;
    std::exception_ptr error;
    {
      const std::scoped_lock lock(mutex_);
      answers.swap(answers_);
      error = std::exchange(error_, nullptr);
    }
    for (std::string& answer : answers) ranks_.send(0, Topic::evaluated, std::move(answer));
    if (error) ranks_.send(0, Topic::finished, text_of(report_of(ranks_, error)));
  }

  void end() {
    {
      const std::scoped_lock lock(mutex_);
      stop_ = true;
      wake_.notify_all();
    }
    for (std::thread& thread : threads_)
      if (thread.joinable()) thread.join();
  }

 private:
  void work(std::size_t thread) {
    for (;;) {
      SentQuestion question;
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return stop_ || !questions_.empty(); });
        if (stop_) return;
        question = std::move(questions_.front());
        questions_.pop_front();
      }
      try {
        std::string answer =
            answer_bytes(question.number, evaluate_({question.u, question.give_up_at, thread, question.whole != 0}));
        const std::scoped_lock lock(mutex_);
        answers_.push_back(std::move(answer));
      } catch (const claims::EvaluationStopped&) {
        return;
      } catch (...) {
        const std::scoped_lock lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
    }
  }

  Ranks& ranks_;
  const claims::Evaluator& evaluate_;
  std::atomic<bool>& stop_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<SentQuestion> questions_;
  std::vector<std::string> answers_;
  std::exception_ptr error_;
  std::vector<std::thread> threads_;
};

int follow(const Arguments& arguments, std::string_view command, const MakeEvaluator& make) {
  Ranks& ranks = *arguments.ranks;
  std::atomic<bool> stop{false};
  std::optional<input::LoadedInput> input;
  claims::Evaluator evaluate;
  std::string identity;
  std::exception_ptr error;
  try {
    input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
    identity = identity_of(*input, command, claims::judging_version);
    if (input->study.kind() == claims::claims_kind().name) evaluate = make(*input, stop);
  } catch (...) {
    error = std::current_exception();
  }
  say_hello(arguments, identity, error);
  std::optional<Follower> follower;
  bool stop_sent = false;
  for (Attention attention;;) {
    const auto message = ranks.receive();
    if (message && message->topic == Topic::leave) return static_cast<int>(values_of<Index>(message->bytes).at(0));
    if (message && message->topic == Topic::evaluate && !stop) {
      if (!follower) follower.emplace(ranks, evaluate, arguments.threads, stop);
      follower->take(SentQuestion::from(message->bytes));
    }
    if (message && message->topic == Topic::stop && follower) follower->end();
    if (stop_requested() && !std::exchange(stop_sent, true)) ranks.send(0, Topic::stop, {});
    if (follower) follower->send_answers();
    if (message)
      attention.rouse();
    else
      std::this_thread::sleep_for(attention.pause());
  }
}

}  // namespace

int share_evaluations(const Arguments& arguments, std::string_view command, const MakeEvaluator& evaluator,
                      const std::function<int(SharedEvaluations& shared)>& lead) {
  Ranks& ranks = *arguments.ranks;
  if (ranks.rank() > 0) return follow(arguments, command, evaluator);
  SharedEvaluations shared(arguments);
  if (ranks.size() == 1) return lead(shared);
  int code = bug;
  try {
    code = lead(shared);
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    print_message("{}\n", failure.what());
    code = failure.exit_code();
  }
  let_go(ranks, code);
  return code;
}

}  // namespace epicyclic::app
