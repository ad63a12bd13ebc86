// The processes (ranks) of one run, as mpirun and srun start them, and messages between them.
//
// Two implementations, one of which is linked: mpi.cpp, and alone.cpp where MPI is not there. MPI is started only if a
// launcher's environment says that this process is one of several. All calls come from the thread that made the object
// (MPI_THREAD_FUNNELED: the weakest that MPI libraries offer to programs with threads), and none of them waits: MPI
// libraries wait by spinning, which takes a core from the computation.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace epicyclic::app {

/// What a message is about; see shared_sweep.cpp and shared_evaluations.cpp.
enum class Topic : int {
  hello,
  begin,
  request_chains,
  chains,
  request_end_state,
  end_state,
  progress,
  stop,
  finished,
  write,
  written,
  evaluate,
  evaluated,
  leave
};

struct Message {
  int from = 0;
  Topic topic = Topic::hello;
  std::string bytes;
};

class Ranks {
 public:
  /// Joins the other ranks, if there are any.
  Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  /// Leaves them: all must come here.
  ~Ranks();

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }

  /// Can ranks talk to each other? Not in a program that was built without MPI.
  [[nodiscard]] bool connected() const { return connected_; }

  /// Sends, and returns at once. Messages between two ranks arrive in order.
  void send(int to, Topic topic, std::string bytes);

  /// A message that has arrived, if there is one.
  [[nodiscard]] std::optional<Message> receive();

  /// Ends all ranks, however they are.
  [[noreturn]] void abort(int exit_code);

 private:
  struct Outbox;
  int rank_ = 0;
  int size_ = 1;
  bool connected_ = false;
  std::unique_ptr<Outbox> outbox_;
};

/// Of the library in use, as it names itself; empty without MPI.
[[nodiscard]] std::string mpi_version();

}  // namespace epicyclic::app
