// HTTP by cpp-httplib, which parses requests and writes answers. What it parses is prepared here: the head is read as a
// whole within a time limit and a size limit, and only the headers that `serve` uses are handed on. So no request can
// hold a thread for long, and ranges, encodings, chunks and whatever else the library knows are never reached.

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <mutex>
#include <set>
#include <string_view>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <httplib.h>
#include <poll.h>
#include <sys/socket.h>

#include "core/errors.hpp"
#include "http.hpp"

namespace epicyclic::app {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds time_to_send_request{4};
constexpr std::chrono::seconds time_to_take_answer{60};
constexpr std::size_t head_bytes_max = std::size_t{16} << 10;
constexpr std::size_t target_bytes_max = 256;
constexpr std::size_t threads = 32;
/// What is used of a request; each at most once.
constexpr std::array<std::string_view, 4> known_headers = {"host", "origin", "content-type", "content-length"};

/// @returns false when the time is over
bool wait_for(socket_t socket, short event, Clock::time_point end) {
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd waited{socket, event, 0};
    const int ready = ::poll(&waited, 1, static_cast<int>(left));
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

/// At most so many bytes that are there; -1 at the end of the time.
ssize_t receive(socket_t socket, char* bytes, std::size_t most, Clock::time_point end) {
  if (!wait_for(socket, POLLIN, end)) return -1;
  return ::recv(socket, bytes, most, 0);
}

/// A connection with a prepared head in front of what is still to be read.
class Connection : public httplib::Stream {
 public:
  Connection(socket_t socket, std::string ahead, Clock::time_point end)
      : socket_(socket), ahead_(std::move(ahead)), end_(end), last_(Clock::now() + time_to_take_answer) {}

  [[nodiscard]] bool is_readable() const override { return at_ < ahead_.size() || wait_for(socket_, POLLIN, end_); }
  [[nodiscard]] bool is_writable() const override { return wait_for(socket_, POLLOUT, last_); }
  ssize_t read(char* bytes, size_t size) override {
    if (at_ < ahead_.size()) {
      const std::size_t count = std::min(size, ahead_.size() - at_);
      std::copy_n(ahead_.data() + at_, count, bytes);
      at_ += count;
      return static_cast<ssize_t>(count);
    }
    return receive(socket_, bytes, size, end_);
  }
  ssize_t write(const char* bytes, size_t size) override {
    if (!wait_for(socket_, POLLOUT, last_)) return -1;
    return ::send(socket_, bytes, size, MSG_NOSIGNAL);
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override { (ip = "127.0.0.1", port = 0); }
  void get_local_ip_and_port(std::string& ip, int& port) const override { (ip = "127.0.0.1", port = 0); }
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  socket_t socket_;
  std::string ahead_;
  std::size_t at_ = 0;
  Clock::time_point end_;
  Clock::time_point last_;
};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// The head with the headers that are used.
/// @returns the status to refuse it with, or 0
int prepare(std::string_view head, std::string& prepared) {
  std::size_t line_end = head.find("\r\n");
  const std::string_view first = head.substr(0, line_end);
  if (first.size() > target_bytes_max) return 414;
  if (std::ranges::any_of(first, [](unsigned char c) { return c < 0x20 || c >= 0x7F; })) return 400;
  prepared = std::string(first) + "\r\n";
  std::set<std::string> seen;
  for (head.remove_prefix(line_end + 2); !head.starts_with("\r\n"); head.remove_prefix(line_end + 2)) {
    line_end = head.find("\r\n");
    const std::string_view line = head.substr(0, line_end);
    if (std::ranges::any_of(line, [](unsigned char c) { return (c < 0x20 && c != '\t') || c == 0x7F; })) return 400;
    const std::string name = lower_case(line.substr(0, line.find(':')));
    if (name.size() == line.size() || name.empty() || name.find_first_of(" \t") != std::string::npos) return 400;
    if (name == "transfer-encoding" || name == "content-encoding") return 501;
    if (std::ranges::find(known_headers, name) == known_headers.end()) continue;
    if (!seen.insert(name).second) return 400;
    prepared += std::string(line) + "\r\n";
  }
  prepared += "Connection: close\r\n\r\n";
  return 0;
}

class LibraryServer : public httplib::Server {
 public:
  /// Wakes up all that wait for a client.
  void end_connections() {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
    for (const socket_t socket : open_) ::shutdown(socket, SHUT_RDWR);
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    {
      const std::scoped_lock lock(mutex_);
      open_.insert(socket);
      if (ending_) ::shutdown(socket, SHUT_RDWR);
    }
    serve(socket);
    const std::scoped_lock lock(mutex_);
    open_.erase(socket);
    ::shutdown(socket, SHUT_RDWR);
    ::close(socket);
    return true;
  }

  void serve(socket_t socket) {
    const Clock::time_point end = Clock::now() + time_to_send_request;
    std::string text;
    std::size_t head_end = std::string::npos;
    while (head_end == std::string::npos) {
      if (text.size() > head_bytes_max) return refuse(socket, 431);
      std::array<char, 4096> bytes{};
      const ssize_t count = receive(socket, bytes.data(), bytes.size(), end);
      if (count <= 0) return;
      const std::size_t from = text.size() < 3 ? 0 : text.size() - 3;
      text.append(bytes.data(), static_cast<std::size_t>(count));
      head_end = text.find("\r\n\r\n", from);
    }
    std::string prepared;
    if (const int status = prepare(std::string_view(text).substr(0, head_end + 4), prepared); status != 0)
      return refuse(socket, status);
    Connection connection(socket, prepared + text.substr(head_end + 4), end);
    bool closed = false;
    (void)process_request(connection, true, closed, nullptr);
  }

  static void refuse(socket_t socket, int status) {
    const std::string text =
        fmt::format("HTTP/1.1 {} Refused\r\nConnection: close\r\nContent-Length: 0\r\n\r\n", status);
    (void)::send(socket, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }

  std::mutex mutex_;
  std::set<socket_t> open_;
  bool ending_ = false;
};

HttpRequest request_of(const httplib::Request& request) {
  HttpRequest made{.method = request.method, .target = request.target};
  const auto header = [&](const char* name, std::optional<std::string>& value) {
    if (request.has_header(name)) value = request.get_header_value(name);
  };
  header("Host", made.host);
  header("Origin", made.origin);
  header("Content-Type", made.content_type);
  header("Content-Length", made.content_length);
  made.body = request.body;
  return made;
}

void put(const HttpAnswer& answer, httplib::Response& response) {
  response.status = answer.status;
  response.set_content(answer.body, answer.type);
}

class LoopbackServer : public HttpServer {
 public:
  explicit LoopbackServer(int port) {
    // Without SO_REUSEPORT, which the library sets: two programs must not share a port.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server_.new_task_queue = [] { return new httplib::ThreadPool(threads); };
    port_ = port == 0 ? server_.bind_to_any_port("127.0.0.1") : server_.bind_to_port("127.0.0.1", port) ? port : -1;
    if (port_ <= 0) throw InputError(fmt::format("--port {}: cannot be opened; another program may have it", port));
  }
  ~LoopbackServer() override { LoopbackServer::stop(); }

  [[nodiscard]] int port() const override { return port_; }

  void start(Handlers handlers) override {
    handlers_ = std::move(handlers);
    server_.set_payload_max_length(body_bytes_max);
    server_.set_default_headers({{"Cache-Control", "no-store"},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"X-Frame-Options", "DENY"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"Cross-Origin-Resource-Policy", "same-origin"}});
    // What has no body is answered here; the library routes only what a body belongs to.
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      const HttpRequest made = request_of(request);
      if (const auto refused = handlers_.refuse(made))
        put(*refused, response);
      else if (made.method == "POST")
        return httplib::Server::HandlerResponse::Unhandled;
      else
        put(handlers_.answer(made), response);
      return httplib::Server::HandlerResponse::Handled;
    });
    server_.Post("/[0-9a-z/]+", [this](const httplib::Request& request, httplib::Response& response) {
      put(handlers_.answer(request_of(request)), response);
    });
    listener_ = std::thread([this] { server_.listen_after_bind(); });
  }

  void stop() override {
    if (!listener_.joinable()) return;
    // It may not listen yet.
    for (int k = 0; k < 1000 && !server_.is_running(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    server_.end_connections();
    server_.stop();
    listener_.join();
  }

 private:
  LibraryServer server_;
  Handlers handlers_;
  int port_ = 0;
  std::thread listener_;
};

}  // namespace

std::unique_ptr<HttpServer> HttpServer::on_loopback(int port) { return std::make_unique<LoopbackServer>(port); }

}  // namespace epicyclic::app
