// Lines that tell what is wrong with an input, "pointer: words", looked at in tests.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace epicyclic::test {

inline std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

inline bool has_line(const std::vector<std::string>& lines, const std::string& pointer, const std::string& words) {
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.starts_with(pointer + ": ") && line.find(words) != std::string::npos;
  });
}

}  // namespace epicyclic::test
