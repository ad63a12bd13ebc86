#include "host.hpp"

#include <utility>

namespace epicyclic::app {

namespace {

thread_local Host* of_this_thread = nullptr;

}  // namespace

Host* host() { return of_this_thread; }

HostScope::HostScope(Host* host) : before_(std::exchange(of_this_thread, host)) {}

HostScope::~HostScope() { of_this_thread = before_; }

}  // namespace epicyclic::app
