#include "store/digest.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <openssl/evp.h>

#include "core/csv.hpp"
#include "core/errors.hpp"

namespace epicyclic::store {

namespace {

// Up to here each integral double is one integer, so that 1e5 and 100000 can share a text.
constexpr double largest_exact_integer = 9007199254740992.0;

void append_canonical(std::string& text, const nlohmann::json& value);

void append_text(std::string& text, const std::string& value) {
  try {
    text += nlohmann::json(value).dump();
  } catch (const nlohmann::json::type_error&) {
    throw InputError("a text of the input is not valid UTF-8");
  }
}

void append_float(std::string& text, double value) {
  if (!std::isfinite(value)) throw InputError("a number of the input is not finite");
  if (std::trunc(value) == value && std::abs(value) <= largest_exact_integer) {
    text += std::to_string(static_cast<std::int64_t>(value));
  } else {
    append_number(text, value);
  }
}

void append_array(std::string& text, const nlohmann::json& value) {
  text += '[';
  const char* separator = "";
  for (const nlohmann::json& element : value) {
    text += separator;
    append_canonical(text, element);
    separator = ",";
  }
  text += ']';
}

void append_object(std::string& text, const nlohmann::json& value) {
  text += '{';
  const char* separator = "";
  // nlohmann::json keeps objects in a std::map, hence sorted by the bytes of the key.
  for (const auto& [key, element] : value.items()) {
    text += separator;
    append_text(text, key);
    text += ':';
    append_canonical(text, element);
    separator = ",";
  }
  text += '}';
}

void append_canonical(std::string& text, const nlohmann::json& value) {
  if (value.is_object()) return append_object(text, value);
  if (value.is_array()) return append_array(text, value);
  if (value.is_string()) return append_text(text, value.get_ref<const std::string&>());
  if (value.is_number_float()) return append_float(text, value.get<double>());
  text += value.dump();
}

void require(bool done) {
  if (!done) throw std::runtime_error("OpenSSL cannot compute SHA-256");
}

}  // namespace

struct Sha256::Context {
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> of_openssl{EVP_MD_CTX_new(), EVP_MD_CTX_free};
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  require(context_->of_openssl != nullptr && EVP_DigestInit_ex(context_->of_openssl.get(), EVP_sha256(), nullptr) == 1);
}

Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes) {
  require(EVP_DigestUpdate(context_->of_openssl.get(), bytes.data(), bytes.size()) == 1);
}

std::string Sha256::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  require(EVP_DigestFinal_ex(context_->of_openssl.get(), digest.data(), &size) == 1);
  std::string text;
  for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string sha256_hex(std::string_view bytes) {
  Sha256 sha;
  sha.add(bytes);
  return sha.hex();
}

std::string canonical_json(const nlohmann::json& value) {
  std::string text;
  append_canonical(text, value);
  return text;
}

}  // namespace epicyclic::store
