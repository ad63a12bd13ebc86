#include "failure.hpp"

#include <system_error>

#include "commands.hpp"
#include "core/errors.hpp"
#include "store/journal.hpp"

namespace epicyclic::app {

Failure failure_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Failure& e) {
    return e;
  } catch (const InputError& e) {
    return {bad_input, e.what()};
  } catch (const OutputError& e) {
    return {output_failed, e.what()};
  } catch (const store::DamagedData& e) {
    return {damaged_data, std::string("damaged data: ") + e.what()};
  } catch (const store::JournalInUse& e) {
    return {folder_in_use, e.what()};
  } catch (const std::system_error& e) {
    return {output_failed, std::string("output: ") + e.what()};
  } catch (const std::exception& e) {
    return {bug, std::string("internal error, please report it: ") + e.what()};
  }
}

}  // namespace epicyclic::app
