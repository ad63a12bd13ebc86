#include <array>
#include <chrono>
#include <cstdlib>
#include <list>
#include <thread>
#include <utility>

#include <mpi.h>

#include "ranks.hpp"

namespace epicyclic::app {

namespace {

/// Set by Open MPI's mpirun, by PMI-1 and PMI-2 (MPICH's mpiexec, srun --mpi=pmi2) and by PMIx (srun --mpi=pmix).
/// Slurm's own variables would not do: a batch script has them too.
bool launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMI_SIZE", "PMIX_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

}  // namespace

/// Messages that are being sent, with their bytes.
struct Ranks::Outbox {
  struct Sent {
    std::string bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  std::list<Sent> sent;

  void clear_delivered() {
    sent.remove_if([](Sent& s) {
      int delivered = 0;
      MPI_Test(&s.request, &delivered, MPI_STATUS_IGNORE);
      return delivered != 0;
    });
  }
};

Ranks::Ranks() {
  if (!launched()) return;
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  connected_ = true;
  outbox_ = std::make_unique<Outbox>();
}

Ranks::~Ranks() {
  if (!connected_) return;
  for (outbox_->clear_delivered(); !outbox_->sent.empty(); outbox_->clear_delivered())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  MPI_Finalize();
}

void Ranks::send(int to, Topic topic, std::string bytes) {
  outbox_->clear_delivered();
  Outbox::Sent& sent = outbox_->sent.emplace_back();
  sent.bytes = std::move(bytes);
  MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, to, static_cast<int>(topic),
            MPI_COMM_WORLD, &sent.request);
}

std::optional<Message> Ranks::receive() {
  outbox_->clear_delivered();
  int arrived = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &status);
  if (arrived == 0) return std::nullopt;
  int length = 0;
  MPI_Get_count(&status, MPI_BYTE, &length);
  Message message{status.MPI_SOURCE, static_cast<Topic>(status.MPI_TAG),
                  std::string(static_cast<std::size_t>(length), '\0')};
  MPI_Recv(message.bytes.data(), length, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return message;
}

void Ranks::abort(int exit_code) {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

std::string mpi_version() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string version = text.data();
  return version.substr(0, version.find(','));
}

}  // namespace epicyclic::app
