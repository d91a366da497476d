// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/sample_buckets.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/rng.hpp"

namespace microswarm::planning {
namespace {

TEST(SampleBuckets, FindsWhatBruteForceFinds) {
  Rng rng(1, Purpose::test);
  for (int trial = 0; trial < 60; ++trial) {
    const double height = trial % 3 == 0 ? 0 : rng.uniform(1, 500);  // a line, too
    std::vector<Vec2> points(1 + rng.below(300));
    for (Vec2& p : points) p = {rng.uniform(-50, 700), rng.uniform(0, 1) * height};
    for (std::size_t i = 0; i + 1 < points.size(); i += 7) points[i + 1] = points[i];
    const double radius = trial % 5 == 0 ? 1e-3 : rng.uniform(1, 300);
    const SampleBuckets buckets(points, radius);
    for (const Vec2 p : points) {
      std::vector<std::uint32_t> found{99};
      buckets.append_near(p, found);
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < points.size(); ++i)
        if (points[i] != p && squared_norm(points[i] - p) <= radius * radius) expected.push_back(i);
      ASSERT_EQ(found.front(), 99u);
      found.erase(found.begin());
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, expected);
    }
  }
}

}  // namespace
}  // namespace microswarm::planning
