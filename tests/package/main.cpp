// A program outside the project, built against the installed package.
#include <cstdio>

#include <epicyclic/core/errors.hpp>

int main() {
  try {
    throw epicyclic::InputError("module_mm: -1 is not above 0");
  } catch (const epicyclic::InputError& error) {
    std::puts(error.what());
    return 0;
  }
}
