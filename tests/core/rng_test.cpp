// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/maths/rng.hpp"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace microswarm {
namespace {

using Words4 = std::array<std::uint32_t, 4>;

Words4 philox(Words4 counter, std::array<std::uint32_t, 2> key) {
  const philox4x32_ctr_t c{{counter[0], counter[1], counter[2], counter[3]}};
  const philox4x32_key_t k{{key[0], key[1]}};
  const philox4x32_ctr_t r = philox4x32(c, k);
  return {r.v[0], r.v[1], r.v[2], r.v[3]};
}

// Random123's published known answers for philox4x32, 10 rounds.
TEST(Rng, TheLibraryGivesThePublishedAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words4{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t f = 0xffffffff;
  EXPECT_EQ(philox({f, f, f, f}, {f, f}), (Words4{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words4{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Rng, StreamStartsAtThePublishedZeroVector) {
  Rng rng(0, Purpose{0}, 0);
  EXPECT_EQ(rng.bits(), 0xe169c58d6627e8d5ULL);
  EXPECT_EQ(rng.bits(), 0x9b00dbd8bc57ac4cULL);
}

TEST(Rng, StreamIsTheCounterUnderTheKey) {
  const std::uint64_t seed = 0x299f31d0a4093822ULL;
  const std::uint32_t trial = 0x13198a2e;
  Rng rng(seed, Purpose::scene, trial);
  for (std::uint32_t block = 0; block < 100; ++block) {
    const Words4 r = philox({block, 0, trial, static_cast<std::uint32_t>(Purpose::scene)},
                            {0xa4093822, 0x299f31d0});
    EXPECT_EQ(rng.bits(), r[0] | static_cast<std::uint64_t>(r[1]) << 32);
    EXPECT_EQ(rng.bits(), r[2] | static_cast<std::uint64_t>(r[3]) << 32);
  }
}

TEST(Rng, NumbersAheadAreThoseDrawn) {
  Rng which(1, Purpose::test), plain(2, Purpose::test), ahead(2, Purpose::test);
  for (int i = 0; i < 10'000; ++i) {
    const std::size_t count = which.below(Rng::max_ahead + 1);
    const auto seen = ahead.ahead(count);
    ASSERT_EQ(seen.size(), count);
    Rng copy = plain;
    for (const std::uint64_t bits : seen) ASSERT_EQ(bits, copy.bits());
    const std::size_t drawn = which.below(count + 1);
    ahead.skip(drawn);
    for (std::size_t k = 0; k < drawn; ++k) plain.bits();
    if (which.below(2) == 0) {
      ASSERT_EQ(ahead.bits(), plain.bits());
    }
  }
}

TEST(Rng, NoTwoKeysShareNumbers) {
  std::set<std::uint64_t> seen;
  std::size_t drawn = 0;
  for (std::uint64_t seed : {0ULL, 1ULL, 1ULL << 32, ~0ULL})
    for (Purpose purpose : {Purpose::planner, Purpose::plant, Purpose::test})
      for (std::uint32_t trial : {0u, 1u, 2u}) {
        Rng rng(seed, purpose, trial);
        for (int i = 0; i < 200; ++i, ++drawn) seen.insert(rng.bits());
      }
  EXPECT_EQ(seen.size(), drawn);
}

TEST(Rng, ACopyContinuesIndependently) {
  Rng a(7, Purpose::test);
  a.bits();
  Rng b = a;
  std::vector<std::uint64_t> from_a, from_b;
  for (int i = 0; i < 20; ++i) from_a.push_back(a.bits());
  for (int i = 0; i < 20; ++i) from_b.push_back(b.bits());
  EXPECT_EQ(from_a, from_b);
}

TEST(Rng, UniformFillsItsRangeEvenly) {
  Rng rng(3, Purpose::test);
  std::array<int, 10> tenths{};
  const int n = 100'000;
  for (int i = 0; i < n; ++i) {
    const double u = rng.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    ++tenths[static_cast<std::size_t>(u * 10)];
  }
  for (int count : tenths) EXPECT_NEAR(count, n / 10, 5 * std::sqrt(n * 0.09));
  for (int i = 0; i < 1000; ++i) {
    const double u = rng.uniform(-3, 5);
    EXPECT_GE(u, -3);
    EXPECT_LT(u, 5);
  }
}

TEST(Rng, BelowReachesEveryValueEvenly) {
  Rng rng(4, Purpose::test);
  std::array<int, 7> counts{};
  const int n = 70'000;
  for (int i = 0; i < n; ++i) ++counts.at(rng.below(7));
  for (int count : counts) EXPECT_NEAR(count, n / 7, 5 * std::sqrt(n / 7.0));
  for (int i = 0; i < 100; ++i) EXPECT_EQ(rng.below(1), 0u);
}

TEST(Rng, NormalHasItsMomentsAndTakesTwoDraws) {
  Rng rng(5, Purpose::test);
  Rng beside = rng;
  const int n = 100'000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double x = rng.normal();
    ASSERT_TRUE(std::isfinite(x));
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 5 * std::sqrt(2.0 / n));
  for (int i = 0; i < 2 * n; ++i) beside.bits();
  EXPECT_EQ(rng.bits(), beside.bits());
}

}  // namespace
}  // namespace microswarm
