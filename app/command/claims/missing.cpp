// In place of the commands on claims, in a program that was built without them.

#include "claims_commands.hpp"
#include "core/errors.hpp"
#include "input/study_kind.hpp"

namespace epicyclic::app {

namespace {

constexpr const char* words =
    "this program was built without claims (reproduce, calibrate, robustness), which need pagmo; `app/run reproduce "
    "NAME` installs it and builds them, and so does -D EPICYCLIC_CLAIMS=ON where it is installed (Debian: "
    "libpagmo-dev)";

}  // namespace

void add_claims_kind() {
  static const input::StudyKind kind = {.name = "claims", .commands = "", .missing = words};
  input::add_kind(kind);
}

int reproduce_command(const Arguments& /*arguments*/) { throw InputError(words); }
int robustness_command(const Arguments& /*arguments*/) { throw InputError(words); }
int calibrate_command(const Arguments& /*arguments*/) { throw InputError(words); }

}  // namespace epicyclic::app
