#include "gate.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <sys/random.h>

namespace epicyclic::app {

namespace {

HttpAnswer refused(int status, const char* why) {
  return {status, "application/json", fmt::format("{{\"error\": \"{}\"}}", why)};
}

}  // namespace

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "no random numbers");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  volatile unsigned char different = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    different =
        static_cast<unsigned char>(different | (static_cast<unsigned char>(a[k]) ^ static_cast<unsigned char>(b[k])));
  return different == 0;
}

Gate::Gate(std::string token, int port, std::vector<std::string> actions)
    : token_(std::move(token)), port_(port), actions_(std::move(actions)) {}

std::optional<HttpAnswer> Gate::refuse(const HttpRequest& request) const {
  const std::array<std::string, 2> hosts = {fmt::format("127.0.0.1:{}", port_), fmt::format("localhost:{}", port_)};
  const auto is_own = [&](const std::string& text, const char* begin) {
    return std::ranges::any_of(hosts, [&](const std::string& host) { return text == begin + host; });
  };
  // A page of another site can make a browser send requests here, but not with these.
  if (!request.host || !is_own(*request.host, "")) return refused(403, "another host");
  if (request.origin && !is_own(*request.origin, "http://")) return refused(403, "another origin");
  if (request.method != "GET" && request.method != "POST") return refused(405, "no such method");
  // Browsers request it without a path of ours.
  if (request.method == "GET" && request.target == "/favicon.ico") return HttpAnswer{204, "text/plain", ""};
  const std::string& target = request.target;
  if (target.size() < token_.size() + 2 || target.front() != '/' || target[token_.size() + 1] != '/' ||
      !same_secret(std::string_view(target).substr(1, token_.size()), token_))
    return refused(403, "no valid token");
  const std::string action = action_of(request);
  const bool is_page = action.empty();
  if (!is_page && std::ranges::find(actions_, action) == actions_.end()) return refused(404, "no such page");
  if (request.method != (is_page ? "GET" : "POST")) return refused(405, "no such method");
  if (is_page) return {};
  if (request.content_type != "application/json") return refused(415, "not application/json");
  std::size_t length = 0;
  const std::string& text = request.content_length.value_or("");
  const auto read = std::from_chars(text.data(), text.data() + text.size(), length);
  if (text.empty() || read.ec != std::errc() || read.ptr != text.data() + text.size())
    return refused(411, "no valid length");
  if (length > body_bytes_max) return refused(413, "too long");
  return {};
}

std::string Gate::action_of(const HttpRequest& request) const { return request.target.substr(token_.size() + 2); }

}  // namespace epicyclic::app
