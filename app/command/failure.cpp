#include "failure.hpp"

#include <cstdlib>
#include <new>
#include <system_error>

#include <unistd.h>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "stop.hpp"
#include "store/journal.hpp"

namespace epicyclic::app {

Failure failure_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Failure& e) {
    return e;
  } catch (const Stopped& e) {
    return {stopped_early, e.what()};
  } catch (const std::bad_alloc&) {
    return {output_failed, out_of_memory};
  } catch (const InputError& e) {
    return {bad_input, e.what()};
  } catch (const OutputError& e) {
    return {output_failed, e.what()};
  } catch (const store::DamagedData& e) {
    return {damaged_data, std::string("damaged data: ") + e.what()};
  } catch (const store::JournalInUse& e) {
    return {folder_in_use, e.what()};
  } catch (const std::system_error& e) {
    // Threads that the system does not give.
    if (e.code() == std::errc::resource_unavailable_try_again || e.code() == std::errc::not_enough_memory)
      return {output_failed, out_of_memory};
    return {output_failed, std::string("output: ") + e.what()};
  } catch (const std::exception& e) {
    return {bug, std::string("internal error, please report it: ") + e.what()};
  }
}

void end_uncaught() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    for (const char* words : {out_of_memory, "\n"}) write_without_waiting(STDERR_FILENO, words);
    leave_at_once(output_failed);
  } catch (...) {
    // A bug: its trace is worth more than words.
  }
  std::abort();
}

}  // namespace epicyclic::app
