// Which requests `serve` answers: those with its token, made by its own page, for one of a few paths.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "http.hpp"

namespace epicyclic::app {

/// 128 bits from the operating system, in hexadecimal digits.
/// @throws std::system_error
[[nodiscard]] std::string random_token();

class Gate {
 public:
  /// @param actions  what the page may request by POST
  Gate(std::string token, int port, std::vector<std::string> actions);

  /// "/TOKEN/", where the page is.
  [[nodiscard]] std::string page() const { return "/" + token_ + "/"; }

  /// The answer to what is not permitted; nothing of a good request.
  [[nodiscard]] std::optional<HttpAnswer> refuse(const HttpRequest& request) const;

  /// Of a good request: one of the actions, or empty of the page itself.
  [[nodiscard]] std::string action_of(const HttpRequest& request) const;

 private:
  std::string token_;
  int port_;
  std::vector<std::string> actions_;
};

/// In a time that does not depend on where they differ.
[[nodiscard]] bool same_secret(std::string_view a, std::string_view b);

}  // namespace epicyclic::app
