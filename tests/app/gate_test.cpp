// Which requests `serve` answers.
#include "serve/gate.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace epicyclic::app {
namespace gate_test {
namespace {

constexpr int port = 4321;
const std::string token(32, 'a');

Gate gate() { return {token, port, {"state", "data"}}; }

HttpRequest page() { return {.method = "GET", .target = "/" + token + "/", .host = "127.0.0.1:4321"}; }

HttpRequest action(const std::string& name) {
  HttpRequest request = page();
  request.method = "POST";
  request.target += name;
  request.content_type = "application/json";
  request.content_length = "2";
  return request;
}

int status(const HttpRequest& request) {
  const auto refused = gate().refuse(request);
  return refused ? refused->status : 200;
}

}  // namespace

TEST(Gate, AnswersItsPageAlone) {
  EXPECT_EQ(gate().page(), "/" + token + "/");
  EXPECT_EQ(status(page()), 200);
  EXPECT_EQ(status(action("state")), 200);
  EXPECT_EQ(gate().action_of(action("state")), "state");
  EXPECT_EQ(gate().action_of(page()), "");
  HttpRequest request = action("data");
  request.origin = "http://localhost:4321";
  EXPECT_EQ(status(request), 200);
  request.origin = "http://localhost:4322";
  EXPECT_EQ(status(request), 403);
}

TEST(Gate, RefusesOtherHosts) {
  HttpRequest request = page();
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:432", "127.0.0.1:43210", "example.org:4321", "[::1]:4321"}) {
    request.host = host;
    EXPECT_EQ(status(request), 403) << host;
  }
  request.host.reset();
  EXPECT_EQ(status(request), 403);
}

TEST(Gate, RefusesOtherTokensAndPaths) {
  for (const std::string& target :
       {std::string(), std::string("/"), "/" + token, "/" + token.substr(1) + "/", "/" + token + "a/",
        "//" + token + "/", "/" + token.substr(1) + "b/", "/" + std::string(32, '/') + "/"}) {
    HttpRequest request = page();
    request.target = target;
    EXPECT_EQ(status(request), 403) << target;
  }
  EXPECT_EQ(status(action("else")), 404);
  EXPECT_EQ(status(action("state/")), 404);
  EXPECT_EQ(status(action("../data")), 404);
}

TEST(Gate, RefusesOtherMethodsAndBodies) {
  HttpRequest request = page();
  request.method = "POST";
  EXPECT_EQ(status(request), 405);
  request = action("state");
  request.method = "GET";
  EXPECT_EQ(status(request), 405);
  request = action("state");
  for (const char* type : {"text/plain", "application/json; charset=utf-8", ""}) {
    request.content_type = type;
    EXPECT_EQ(status(request), 415) << type;
  }
  request = action("state");
  for (const char* length : {"", "-1", "1 ", "1,2", "99999999999999999999999"}) {
    request.content_length = length;
    EXPECT_EQ(status(request), 411) << length;
  }
  request.content_length = "65537";
  EXPECT_EQ(status(request), 413);
}

TEST(Gate, ComparesSecretsAndMakesThem) {
  EXPECT_TRUE(same_secret("abc", "abc"));
  EXPECT_FALSE(same_secret("abc", "abd"));
  EXPECT_FALSE(same_secret("abc", "ab"));
  std::set<std::string> tokens;
  for (int k = 0; k < 100; ++k) {
    tokens.insert(random_token());
    EXPECT_EQ(tokens.begin()->size(), 32U);
  }
  EXPECT_EQ(tokens.size(), 100U);
}

}  // namespace gate_test
}  // namespace epicyclic::app
