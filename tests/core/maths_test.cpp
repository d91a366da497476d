// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/maths/maths.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/maths/rng.hpp"

namespace microswarm {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// By how many units in the last place `found` is wrong.
double error_of(double found, long double exact) {
  const double size = std::abs(static_cast<double>(exact));
  return std::abs(static_cast<double>((found - exact) / (std::nextafter(size, infinite) - size)));
}

TEST(Maths, IsRightButForTheLastBit) {
  Rng rng(1, Purpose::test);
  constexpr double most = 1.0;
  for (int k = 0; k < 20'000; ++k) {
    const long double angle = rng.uniform(-1000, 1000);
    const long double share = rng.uniform(-1, 1);
    const long double some = rng.uniform(1e-6, 1e3);
    const auto x = static_cast<double>(angle), u = static_cast<double>(share);
    const auto p = static_cast<double>(some);
    EXPECT_LE(error_of(maths::sin(x), std::sin(angle)), most) << x;
    EXPECT_LE(error_of(maths::cos(x), std::cos(angle)), most) << x;
    EXPECT_LE(error_of(maths::sincos(x).sine, std::sin(angle)), most) << x;
    EXPECT_LE(error_of(maths::sincos(x).cosine, std::cos(angle)), most) << x;
    EXPECT_LE(error_of(maths::asin(u), std::asin(share)), most) << u;
    EXPECT_LE(error_of(maths::acos(u), std::acos(share)), most) << u;
    EXPECT_LE(error_of(maths::atan2(x, p), std::atan2(angle, some)), 1.5) << x << ' ' << p;
    EXPECT_LE(error_of(maths::atan2(u, x), std::atan2(share, angle)), 1.5) << u << ' ' << x;
    EXPECT_LE(error_of(maths::exp(x / 2), std::exp(angle / 2)), most) << x;
    EXPECT_LE(error_of(maths::expm1(u), std::expm1(share)), most) << u;
    EXPECT_LE(error_of(maths::log(p), std::log(some)), most) << p;
    EXPECT_LE(error_of(maths::log1p(u), std::log1p(share)), most) << u;
    EXPECT_LE(error_of(maths::log10(p), std::log10(some)), most) << p;
    EXPECT_LE(error_of(maths::pow(p, u), std::pow(some, share)), most) << p << ' ' << u;
    EXPECT_LE(error_of(maths::tanh(u), std::tanh(share)), most) << u;
  }
}

// Where a whole number of quarters is taken off, and little is left.
TEST(Maths, IsRightNextToQuartersOfATurn) {
  for (int quarters = -700; quarters <= 700; ++quarters)
    for (const double off : {0.0, 1e-12, -1e-9, 5e-5, 7e-5, -1e-4, 1e-3}) {
      const double x = quarters * (pi / 2) + off;
      const long double angle = x;
      const auto [sine, cosine] = maths::sincos(x);
      EXPECT_LE(error_of(maths::sin(x), std::sin(angle)), 1) << x;
      EXPECT_LE(error_of(maths::cos(x), std::cos(angle)), 1) << x;
      EXPECT_LE(error_of(sine, std::sin(angle)), 1) << x;
      EXPECT_LE(error_of(cosine, std::cos(angle)), 1) << x;
    }
}

TEST(Maths, AnglesOfVectorsOfAnySize) {
  for (const double size : {1e-310, 1e-200, 1e-30, 1e-3, 1e3, 1e30, 1e200, 1e308})
    for (const double share : {0.0, 1e-9, 0.03, 0.5, 0.97, 1.0})
      for (const double x : {-size, size})
        for (const double y : {-share * size, share * size}) {
          const long double run = x, rise = y;
          EXPECT_LE(error_of(maths::atan2(y, x), std::atan2(rise, run)), 1.5) << y << ' ' << x;
          EXPECT_LE(error_of(maths::atan2(x, y), std::atan2(run, rise)), 1.5) << x << ' ' << y;
        }
  EXPECT_EQ(maths::atan2(1, infinite), 0);
  EXPECT_EQ(maths::atan2(infinite, 1), pi / 2);
  EXPECT_TRUE(std::isnan(maths::atan2(std::nan(""), 1)));
  EXPECT_TRUE(std::isnan(maths::atan2(1, std::nan(""))));
}

TEST(Maths, IsExactWhereTheAnswerIs) {
  EXPECT_EQ(maths::sin(0), 0);
  EXPECT_EQ(maths::cos(0), 1);
  EXPECT_EQ(maths::sincos(0).sine, 0);
  EXPECT_EQ(maths::sincos(0).cosine, 1);
  EXPECT_EQ(maths::acos(1), 0);
  EXPECT_EQ(maths::acos(-1), pi);
  EXPECT_EQ(maths::asin(1), pi / 2);
  EXPECT_EQ(maths::atan2(0, 0), 0);
  EXPECT_EQ(maths::atan2(0, 1), 0);
  EXPECT_TRUE(std::signbit(maths::atan2(-0.0, 1)));
  EXPECT_TRUE(std::signbit(maths::sin(-0.0)));
  EXPECT_EQ(maths::atan2(-1, 0), -pi / 2);
  EXPECT_EQ(maths::atan2(1, -1), 3 * pi / 4);
  EXPECT_EQ(maths::atan2(1, 0), pi / 2);
  EXPECT_EQ(maths::atan2(0, -1), pi);
  EXPECT_EQ(maths::atan2(-0.0, -1), -pi);
  EXPECT_EQ(maths::atan2(1, 1), pi / 4);
  EXPECT_EQ(maths::exp(0), 1);
  EXPECT_EQ(maths::exp(-infinite), 0);
  EXPECT_EQ(maths::log(1), 0);
  EXPECT_EQ(maths::log(0), -infinite);
  EXPECT_EQ(maths::pow(2, 0), 1);
  EXPECT_EQ(maths::pow(0, 0.3), 0);
  EXPECT_EQ(maths::tanh(40), 1);
  EXPECT_TRUE(std::isnan(maths::acos(1.5)));
  EXPECT_TRUE(std::isnan(maths::sin(infinite)));
  double ten = 1;
  for (int n = 0; n <= 22; ++n, ten *= 10) {
    EXPECT_EQ(maths::log10(ten), n);
    EXPECT_EQ(maths::power(10, n), ten);
    EXPECT_EQ(maths::power(10, -n), 1 / ten);
  }
  static_assert(maths::power(-3, 3) == -27 && maths::power(0.5, -2) == 4);
}

// On any machine, with any C library.
TEST(Maths, HasTheSameBitsEverywhere) {
  Rng rng(2, Purpose::test);
  Hash hash;
  for (int k = 0; k < 100'000; ++k) {
    const double x = rng.uniform(-100, 100), u = rng.uniform(-1, 1), p = rng.uniform(0, 10);
    const auto [sine, cosine] = maths::sincos(x);
    for (const double y : {maths::sin(x), maths::cos(x), sine, cosine, maths::asin(u),
                           maths::acos(u), maths::atan2(x, u), maths::exp(x), maths::expm1(u),
                           maths::log(p), maths::log1p(u), maths::log10(p), maths::pow(p, x),
                           maths::tanh(u), maths::power(p, k % 40 - 20), rng.normal()})
      hash.value(y);
  }
  EXPECT_EQ(hash.hex(), "0791f2a96b2745a6");
}

}  // namespace
}  // namespace microswarm
