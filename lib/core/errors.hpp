// Errors that the library throws. Non-convergence is never one of them: it is a result (see integrate/flow.hpp).
//
//   InputError   what the user wrote is wrong: a value out of range, supports that do not fit the boundary
//   DomainError  a formula was used outside its domain: a negative approach, a contact off the path
//   SolverError  a call into an external library failed: has the call, its flag and the mesh phase
//   OutputError  the machine could not write or read a file; what was written before stays valid
#pragma once

#include <stdexcept>
#include <string>

namespace epicyclic {

/// Wrong input. The message names field, value and bound.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A formula outside its domain of validity.
class DomainError : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// The machine could not write or read a file or folder: no room, no descriptor left [path and reason in the message].
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A failed call of an external solver library.
class SolverError : public std::runtime_error {
 public:
  /// @param call  name of the library function
  /// @param flag  the value that it returned
  /// @param phase mesh phase s at the time of the call [rad]
  SolverError(const std::string& call, int flag, double phase, const std::string& detail)
      : std::runtime_error(call + " returned " + std::to_string(flag) + " at s = " + std::to_string(phase) + ": " +
                           detail),
        call_(call),
        flag_(flag),
        phase_(phase) {}

  [[nodiscard]] const std::string& call() const { return call_; }
  [[nodiscard]] int flag() const { return flag_; }
  [[nodiscard]] double phase() const { return phase_; }

 private:
  std::string call_;
  int flag_;
  double phase_;
};

}  // namespace epicyclic
