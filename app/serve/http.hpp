// HTTP on the loopback interface, for `serve`: one request for each connection. Which requests are permitted is decided
// by others [gate.hpp]; here requests are bounded in size and time.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace epicyclic::app {

/// Longest body of a request [bytes].
inline constexpr std::size_t body_bytes_max = std::size_t{64} << 10;

struct HttpRequest {
  std::string method;
  std::string target;  ///< as sent: nothing in it is decoded
  std::optional<std::string> host{}, origin{}, content_type{}, content_length{};
  std::string body{};
};

struct HttpAnswer {
  int status = 200;
  std::string type = "application/json";
  std::string body{};
};

class HttpServer {
 public:
  /// @param refuse  sees a request before its body is read: an answer ends it
  /// @param answer  called by several threads; must not throw
  struct Handlers {
    std::function<std::optional<HttpAnswer>(const HttpRequest&)> refuse;
    std::function<HttpAnswer(const HttpRequest&)> answer;
  };

  /// Waits for connections to 127.0.0.1.
  /// @param port  0: any that is free
  /// @throws InputError if another program has the port, or if the program was built without HTTP
  [[nodiscard]] static std::unique_ptr<HttpServer> on_loopback(int port);

  virtual ~HttpServer() = default;
  [[nodiscard]] virtual int port() const = 0;

  /// Answers until stop(). To be called once.
  virtual void start(Handlers handlers) = 0;

  /// Ends all connections and waits for the handlers.
  virtual void stop() = 0;
};

}  // namespace epicyclic::app
