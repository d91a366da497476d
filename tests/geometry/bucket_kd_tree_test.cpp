// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/bucket_kd_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "microswarm/core/maths/rng.hpp"
#include "tests/each_target.hpp"

namespace microswarm {
namespace {

using Coordinate = std::function<float(Rng&, std::size_t)>;

std::uint32_t brute_nearest(const std::vector<float>& all, const std::vector<float>& p) {
  float least = std::numeric_limits<float>::infinity();
  std::uint32_t best = 0;
  for (std::uint32_t i = 0; i < all.size() / p.size(); ++i) {
    float square = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const float d = all[i * p.size() + k] - p[k];
      square += d * d;
    }
    if (square < least) {
      least = square;
      best = i;
    }
  }
  return best;
}

void expect_same_as_brute_force(std::size_t dimension, std::size_t count,
                                const Coordinate& coordinate) {
  Rng rng(1, Purpose::test);
  BucketKdTree tree(dimension);
  std::vector<float> all;
  std::vector<float> p(dimension);
  const auto draw = [&](std::size_t i) {
    for (float& x : p) x = coordinate(rng, i);
  };
  for (std::size_t i = 0; i < count; ++i) {
    draw(i);
    tree.add(p);
    all.insert(all.end(), p.begin(), p.end());
    if (i > 130 && i % 41 != 0) continue;
    draw(rng.below(i + 1));
    ASSERT_EQ(tree.nearest(p), brute_nearest(all, p)) << "of " << i + 1 << " in " << dimension;
    const std::size_t old = rng.below(i + 1);
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(old * dimension), dimension, p.begin());
    ASSERT_EQ(tree.nearest(p), brute_nearest(all, p));
    for (float& x : p) x = static_cast<float>(rng.uniform(-1e6, 1e6));
    ASSERT_EQ(tree.nearest(p), brute_nearest(all, p));
  }
  EXPECT_EQ(tree.size(), count);
}

float uniform(Rng& rng, std::size_t) { return static_cast<float>(rng.uniform(-150, 150)); }

TEST(BucketKdTree, UniformPointsInEveryDimension) {
  for (const std::size_t d : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 16, 17, 31, 64, 128})
    expect_same_as_brute_force(d, 3000, uniform);
}

TEST(BucketKdTree, VectorsOfEveryWidthFindTheSame) {
  test::for_each_target([](const char* target) {
    SCOPED_TRACE(target);
    for (const std::size_t d : {1, 2, 3, 8, 17}) {
      expect_same_as_brute_force(d, 1500, uniform);
      expect_same_as_brute_force(
          d, 1500, [](Rng& rng, std::size_t) { return static_cast<float>(rng.below(5)); });
    }
  });
}

TEST(BucketKdTree, LatticeWithTiesAndRepeats) {
  for (const std::size_t d : {1, 2, 3, 8})
    expect_same_as_brute_force(
        d, 4000, [](Rng& rng, std::size_t) { return static_cast<float>(rng.below(5)); });
}

TEST(BucketKdTree, PointsAlongWalls) {
  for (const std::size_t d : {2, 4, 8})
    expect_same_as_brute_force(d, 4000, [](Rng& rng, std::size_t i) {
      return rng.below(3) == 0 ? 150.0f : uniform(rng, i);
    });
}

TEST(BucketKdTree, EqualPointsThenOthers) {
  for (const std::size_t d : {2, 6}) {
    expect_same_as_brute_force(d, 500, [](Rng&, std::size_t) { return 7.0f; });
    expect_same_as_brute_force(d, 2000, [](Rng& rng, std::size_t i) {
      return i < 700 ? 7.0f : static_cast<float>(rng.uniform(0, 20));
    });
    expect_same_as_brute_force(d, 2000, [](Rng&, std::size_t i) { return i < 200 ? 3.0f : 5.0f; });
  }
}

TEST(BucketKdTree, PointsInOrderDoNotMakeItDeep) {
  for (const std::size_t d : {1, 2})
    expect_same_as_brute_force(d, 8000, [](Rng&, std::size_t i) { return static_cast<float>(i); });
}

TEST(BucketKdTree, ScalesOverManyMagnitudes) {
  for (const std::size_t d : {2, 8})
    expect_same_as_brute_force(d, 3000, [](Rng& rng, std::size_t) {
      return static_cast<float>(rng.uniform(-1, 1) * std::pow(10.0, rng.uniform(-9, 9)));
    });
}

}  // namespace
}  // namespace microswarm
