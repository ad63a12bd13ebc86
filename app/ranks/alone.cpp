#include <cstdlib>
#include <initializer_list>
#include <stdexcept>

#include "host.hpp"
#include "ranks.hpp"

namespace epicyclic::app {

namespace {

/// The first of the variables that is set, as a number. A host has its processes for itself.
int number_from(std::initializer_list<const char*> names, int otherwise) {
  if (host() != nullptr) return otherwise;
  for (const char* name : names)
    if (const char* text = std::getenv(name)) return std::atoi(text);
  return otherwise;
}

}  // namespace

struct Ranks::Outbox {};

/// Reports once that several processes cannot work together.
Ranks::Ranks()
    : rank_(number_from({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}, 0)),
      size_(number_from({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 1)) {}

Ranks::~Ranks() = default;

void Ranks::send(int /*to*/, Topic /*topic*/, std::string /*bytes*/) { throw std::logic_error("Ranks: no MPI"); }

std::optional<Message> Ranks::receive() { throw std::logic_error("Ranks: no MPI"); }

void Ranks::abort(int exit_code) { std::_Exit(exit_code); }

std::string mpi_version() { return {}; }

}  // namespace epicyclic::app
