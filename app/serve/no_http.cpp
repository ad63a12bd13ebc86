// `serve` of a program that was built without cpp-httplib.
#include "core/errors.hpp"
#include "http.hpp"

namespace epicyclic::app {

std::unique_ptr<HttpServer> HttpServer::on_loopback(int /*port*/) {
  throw InputError(
      "serve: this program was built without cpp-httplib; install libcpp-httplib-dev and build the program again. "
      "`report` writes the same page as a file");
}

}  // namespace epicyclic::app
