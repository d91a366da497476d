// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/safety_radius.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "microswarm/core/maths/rng.hpp"

namespace microswarm::navigation {
namespace {

/// J of Eq 23 [radar] for the gap x_0.
double cost(const SafetyRadiusParams& p, double gap, const std::vector<double>& inputs) {
  double x = gap;
  double sum = 0;
  for (const double u : inputs) {
    sum += p.collision_weight * x * x + p.speed_weight * u * u;
    x -= p.sample_time * u;
  }
  return sum;
}

/// The inputs 0 … N that minimise it within their bounds, one coordinate after the other until none
/// changes: J is convex, and along one coordinate a parabola.
std::vector<double> brute_force(const SafetyRadiusParams& p, double gap) {
  const double most = std::min(p.max_relative_speed, gap / p.sample_time);
  std::vector<double> u(static_cast<std::size_t>(p.horizon) + 1, 0.0);
  for (int sweep = 0; sweep < 200'000; ++sweep) {
    double moved = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      // From three values of the parabola to its least.
      const double old = u[k];
      const double h = std::max(1.0, most);
      u[k] = 0;
      const double at_0 = cost(p, gap, u);
      u[k] = h;
      const double at_h = cost(p, gap, u);
      u[k] = -h;
      const double at_minus_h = cost(p, gap, u);
      const double bend = (at_h + at_minus_h - 2 * at_0) / (h * h);
      const double slope = (at_h - at_minus_h) / (2 * h);
      u[k] = std::clamp(-slope / bend, 0.0, most);
      moved = std::max(moved, std::abs(u[k] - old));
    }
    if (moved < 1e-12 * (1 + most)) break;
  }
  return u;
}

TEST(SafetyRadius, IsTheOptimum) {
  Rng rng(3, Purpose::test);
  int bounded = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SafetyRadiusParams p;
    p.adaptive = true;
    p.horizon = 1 + static_cast<int>(rng.below(12));
    p.sample_time = rng.uniform(0.02, 0.5);
    p.max_relative_speed = rng.uniform(1, 120);
    p.collision_weight = rng.uniform(0.05, 4);
    p.speed_weight = rng.uniform(0.1, 4);
    const double gap = rng.uniform(0, 200);
    const std::vector<double> best = brute_force(p, gap);
    EXPECT_NEAR(SafetyRadius(p).assumed_speed(gap), best[0], 1e-6 * (1 + best[0])) << trial;
    bounded += best[0] >= p.max_relative_speed;
    EXPECT_LT(best[0] * p.sample_time, gap);  // Eq 22
  }
  EXPECT_GT(bounded, 30);
  EXPECT_LT(bounded, 270);
}

TEST(SafetyRadius, NearerObstaclesWidenTheCircle) {
  SafetyRadiusParams p;
  p.adaptive = true;
  const SafetyRadius control(p);
  double last = 151;
  for (double gap = 0; gap < 100; gap += 5) {
    const double r = control.radius(150, 125, gap);
    EXPECT_LE(r, last);
    EXPECT_GE(r, 125);
    last = r;
  }
  EXPECT_EQ(control.radius(150, 125, 0), 150);
  EXPECT_EQ(control.radius(150, 125, 1e6), 125);
}

TEST(SafetyRadius, StaysWhenNotAdaptive) { EXPECT_EQ(SafetyRadius({}).radius(150, 125, 80), 150); }

}  // namespace
}  // namespace microswarm::navigation
