#include "core/fiber.hpp"

#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace epicyclic::fiber_test {
namespace {

TEST(Fibers, TakeTurnsWhereTheySuspend) {
  std::string told;
  Fiber* inside = nullptr;
  const auto body = [&](char name) {
    return [&told, &inside, name] {
      for (int k = 0; k < 3; ++k) {
        inside = Fiber::current();
        told += name;
        Fiber::suspend();
      }
    };
  };
  Fiber a(body('a'));
  Fiber b(body('b'));
  EXPECT_EQ(Fiber::current(), nullptr);
  for (int k = 0; k < 3; ++k) {
    a.resume();
    EXPECT_EQ(inside, &a);
    b.resume();
    EXPECT_EQ(inside, &b);
    EXPECT_EQ(Fiber::current(), nullptr);
    EXPECT_FALSE(a.over());
  }
  a.resume();
  EXPECT_TRUE(a.over());
  EXPECT_FALSE(b.over());
  EXPECT_EQ(told, "ababab");
}

TEST(Fibers, OfAFiberGoBackToIt) {
  std::string told;
  Fiber outer([&] {
    Fiber inner([&] {
      told += "b";
      Fiber::suspend();
      told += "d";
    });
    told += "a";
    inner.resume();
    told += "c";
    inner.resume();
    told += inner.over() ? "e" : "?";
    Fiber::suspend();
    told += "g";
  });
  outer.resume();
  told += "f";
  outer.resume();
  EXPECT_EQ(told, "abcdefg");
}

TEST(Fibers, LetExceptionsOutOfResume) {
  Fiber fiber([] {
    Fiber::suspend();
    try {
      throw std::runtime_error("first");
    } catch (const std::runtime_error&) {
      // Its own affair.
    }
    throw std::runtime_error("second");
  });
  fiber.resume();
  try {
    fiber.resume();
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "second");
  }
  EXPECT_TRUE(fiber.over());
}

TEST(Fibers, ThatNobodyWaitsForAreUnwound) {
  const auto held = std::make_shared<int>(0);
  bool went_on = false;
  bool caught = false;
  {
    Fiber fiber([&, own = held] {
      const std::shared_ptr<int> mine = own;
      try {
        Fiber::suspend();
      } catch (const std::exception&) {
        caught = true;
      }
      went_on = true;
    });
    fiber.resume();
    EXPECT_GE(held.use_count(), 3);
  }
  EXPECT_EQ(held.use_count(), 1);
  EXPECT_FALSE(went_on);
  EXPECT_FALSE(caught);
  // One that never began has nothing to unwind.
  const Fiber idle([&] { went_on = true; });
  EXPECT_FALSE(idle.over());
}

}  // namespace
}  // namespace epicyclic::fiber_test
