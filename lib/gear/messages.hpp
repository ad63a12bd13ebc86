// Lines "pointer: message" on what is wrong with a stage, collected before they are told all at once.
#pragma once

#include <charconv>
#include <string>
#include <utility>
#include <vector>

namespace epicyclic::gear {

class Problems {
 public:
  /// @param digits  significant digits of numbers; 0: as many as read back as the same number
  explicit Problems(int digits = 0) : digits_(digits) {}

  template <class... Parts>
  void add(const std::string& pointer, const Parts&... parts) {
    std::string line = pointer + ": ";
    (line.append(part(parts)), ...);
    lines_.push_back(line);
  }
  std::vector<std::string> take() { return std::exchange(lines_, {}); }

 private:
  static std::string part(const char* s) { return s; }
  static std::string part(const std::string& s) { return s; }
  /// The same in every locale.
  [[nodiscard]] std::string part(double x) const {
    char buffer[40];
    const auto end = digits_ == 0
                         ? std::to_chars(buffer, buffer + sizeof buffer, x)
                         : std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, digits_);
    return {buffer, end.ptr};
  }

  int digits_;
  std::vector<std::string> lines_;
};

}  // namespace epicyclic::gear
