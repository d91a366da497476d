// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/motion_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/rng.hpp"

namespace microswarm::navigation {
namespace {

/// Third difference of evenly spaced sightings, in standard deviations of a coordinate's noise.
double third_difference_at(const std::vector<Sighting>& s, std::size_t i) {
  return norm(s[i + 3].position - s[i].position + 3 * (s[i + 1].position - s[i + 2].position)) /
         std::sqrt(20.0);
}

TEST(MotionFit, NoiseIsTheMedianThirdDifference) {
  Rng rng(8, Purpose::test);
  const MotionFitTuning tuning;
  int least = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    // About a third of the trails are calmer than the least noise, a third about as calm.
    const double noise = tuning.min_noise * std::pow(10.0, rng.uniform(-2, 2));
    std::vector<Sighting> trail(7 + rng.below(40));
    for (std::size_t i = 0; i < trail.size(); ++i) {
      const double t = 0.1 * static_cast<double>(i);
      const double x = rng.normal();
      trail[i] = {t, Vec2{40 * t, 10 - 20 * t} + noise * Vec2{x, rng.normal()}};
    }
    std::vector<double> differences(trail.size() - 3);
    for (std::size_t i = 0; i < differences.size(); ++i)
      differences[i] = third_difference_at(trail, i);
    std::sort(differences.begin(), differences.end());
    const double median = differences[differences.size() / 2] / 1.1774100225154747;
    ASSERT_EQ(fit_motion(trail, 12, tuning).noise, std::max(tuning.min_noise, median)) << trial;
    least += median < tuning.min_noise ? 1 : 0;
  }
  EXPECT_GT(least, 500);
  EXPECT_LT(least, 1500);
}

}  // namespace
}  // namespace microswarm::navigation
