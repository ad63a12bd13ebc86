#include "store/digest.hpp"

#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"

namespace epicyclic::store::digest_test {
namespace {

using nlohmann::json;

// FIPS 180-4 examples, as published by NIST (Cryptographic Standards and Guidelines, SHA256.pdf) and in the test
// vectors of the NESSIE project.
TEST(Digest, AgreesWithPublishedSha256Vectors) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_hex(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Digest, CanonicalTextHasSortedKeysAndNoSpaces) {
  EXPECT_EQ(canonical_json(json::parse(R"({ "b": [1, true, null, "x y"], "a": {"d": {}, "c": []} })")),
            R"({"a":{"c":[],"d":{}},"b":[1,true,null,"x y"]})");
}

TEST(Digest, OrderSpacingAndNotationDoNotCount) {
  const std::string one = canonical_json(json::parse(R"({"to": 3.5, "points": 1e5, "from": 0.2, "n": 1})"));
  const std::string two = canonical_json(json::parse(R"({"from":2e-1,"n":1.0,"points":100000,"to":35E-1})"));
  EXPECT_EQ(one, two);
  EXPECT_EQ(one, R"({"from":0.2,"n":1,"points":100000,"to":3.5})");
}

TEST(Digest, DifferentNumbersHaveDifferentTexts) {
  const double next = std::nextafter(0.1, 1.0);
  EXPECT_NE(canonical_json(0.1), canonical_json(next));
  EXPECT_EQ(json::parse(canonical_json(next)).get<double>(), next);
  EXPECT_EQ(canonical_json(json::parse("18446744073709551615")), "18446744073709551615");
  EXPECT_EQ(canonical_json(json::parse("-9223372036854775808")), "-9223372036854775808");
  EXPECT_EQ(canonical_json(1e300), "1e+300");
}

TEST(Digest, TextsAreEscapedAndKeptInUtf8) { EXPECT_EQ(canonical_json(json("a\"\\\n\tδ")), "\"a\\\"\\\\\\n\\tδ\""); }

TEST(Digest, WhatJsonCannotSayIsRefused) {
  EXPECT_THROW(canonical_json(json{std::numeric_limits<double>::infinity()}), InputError);
  EXPECT_THROW(canonical_json(json{std::numeric_limits<double>::quiet_NaN()}), InputError);
  EXPECT_THROW(canonical_json(json("\xff\xfe")), InputError);
}

}  // namespace
}  // namespace epicyclic::store::digest_test
