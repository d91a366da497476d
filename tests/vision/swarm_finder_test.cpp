// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/swarm_finder.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "microswarm/core/error.hpp"
#include "microswarm/core/statistics.hpp"
#include "tests/vision/microscope.hpp"

namespace microswarm {
namespace {

using test::DrawnFrame;
using test::DrawnSwarm;

constexpr int width = 640;
constexpr int height = 480;
constexpr double pi = std::numbers::pi;

int clumps_for(double radius) { return static_cast<int>(0.16 * radius * radius); }

/// A swarm of any size, place and shape, under light uneven by up to 40 %, with noise.
struct Scene {
  DrawnSwarm swarm;
  Image picture;
};
Scene scene(std::uint32_t trial, double most_noise) {
  Rng rng(11, Purpose::test, trial);
  Scene s;
  s.swarm.radius = rng.uniform(15, 80);
  const double reach = 1.5 * s.swarm.radius + 4;
  const double x = rng.uniform(reach, width - reach);
  s.swarm.centre = {x, rng.uniform(reach, height - reach)};
  s.swarm.elongation = rng.uniform(1, 2);
  s.swarm.angle = rng.uniform(-pi / 2, pi / 2);
  s.swarm.clumps = clumps_for(s.swarm.radius);
  DrawnFrame frame(width, height);
  frame.swarm(s.swarm, rng);
  const double slope = rng.uniform(0, 0.4);
  const double heading = rng.uniform(-pi, pi);
  s.picture = frame.expose(rng.uniform(110, 170), slope, heading, rng.uniform(0, 0.2),
                           rng.uniform(0, most_noise), rng);
  return s;
}

void expect_finite(const Blob& b) {
  EXPECT_TRUE(is_finite(b.centre_px));
  for (const double v : {b.radius_px, b.semi_major_px, b.semi_minor_px, b.angle, b.contrast})
    EXPECT_TRUE(std::isfinite(v));
  EXPECT_GE(b.semi_major_px, b.semi_minor_px);
  EXPECT_GE(b.outline_px.size(), 3U);
  for (const Vec2 p : b.outline_px) {
    EXPECT_GE(std::min(p.x, p.y), -3);
    EXPECT_LE(p.x, width + 3);
    EXPECT_LE(p.y, height + 3);
  }
}

TEST(SwarmFinder, PlaceSizeAndShapeOfHundredsOfSwarms) {
  for (const double most_noise : {0.0, 10.0}) {
    std::vector<double> off;
    std::vector<double> radius_off;
    std::vector<double> radius_bias;
    std::vector<double> angle_off;
    std::vector<double> ms;
    int missed = 0;
    for (std::uint32_t trial = 0; trial < 300; ++trial) {
      const Scene s = scene(trial, most_noise);
      const auto began = std::chrono::steady_clock::now();
      const SwarmSighting seen = find_swarm(s.picture);
      ms.push_back(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began)
              .count());
      if (seen.sight != SwarmSight::found) {
        ++missed;
        std::printf("trial %u: %s, R %.1f\n", trial, enum_name(seen.sight).data(), s.swarm.radius);
        continue;
      }
      const Blob& b = *seen.swarm;
      expect_finite(b);
      off.push_back(distance(b.centre_px, s.swarm.centre));
      radius_bias.push_back(b.radius_px - s.swarm.radius);
      radius_off.push_back(std::abs(b.radius_px - s.swarm.radius) / s.swarm.radius);
      if (s.swarm.elongation > 1.3)
        angle_off.push_back(std::abs(std::remainder(b.angle - s.swarm.angle, pi)) * 180 / pi);
    }
    std::printf(
        "noise to %.0f: %d missed; place off %.2f px median, %.2f p99, %.2f worst; radius off "
        "%.1f %% median, %.1f %% p99, bias median %.2f px; angle off %.1f deg median, %.1f p99; "
        "%.2f ms median\n",
        most_noise, missed, quantile(off, 0.5), quantile(off, 0.99), quantile(off, 1),
        100 * quantile(radius_off, 0.5), 100 * quantile(radius_off, 0.99),
        quantile(radius_bias, 0.5), quantile(angle_off, 0.5), quantile(angle_off, 0.99),
        quantile(ms, 0.5));
    EXPECT_EQ(missed, 0);
    EXPECT_LT(quantile(off, 0.5), 0.5);
    EXPECT_LT(quantile(off, 0.99), 1.5);
    EXPECT_LT(quantile(radius_off, 0.5), 0.03);
    EXPECT_LT(quantile(radius_off, 0.99), 0.15);
    EXPECT_LT(quantile(angle_off, 0.99), 8);
  }
}

}  // namespace
}  // namespace microswarm
