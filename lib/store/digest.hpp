// Identity of a study: a canonical text of the input and its SHA-256.
//
// The canonical text does not depend on the order of keys, on white space, or on how a number was typed: 1, 1.0 and
// 10e-1 give the same bytes. Numbers are the shortest text that reads back as the same double; integral values up to
// 2^53 in magnitude are written without exponent; integers outside that range keep all their digits.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace epicyclic::store {

/// SHA-256 (FIPS 180-4) of bytes that come one after another.
class Sha256 {
 public:
  /// @throws std::runtime_error when OpenSSL refuses the algorithm, as do the others
  Sha256();
  ~Sha256();
  void add(std::string_view bytes);
  /// 64 lower-case hexadecimal digits; the end.
  [[nodiscard]] std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// SHA-256 of bytes, 64 lower-case hexadecimal digits.
/// @throws std::runtime_error when OpenSSL refuses the algorithm
std::string sha256_hex(std::string_view bytes);

/// Canonical UTF-8 text of a JSON value: keys sorted by their bytes, no spaces.
/// @throws InputError when a number is not finite or a text is not UTF-8, for which JSON has no representation
std::string canonical_json(const nlohmann::json& value);

}  // namespace epicyclic::store
