// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/channel.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

const DeformingChannel winding{.centre_line = {{-800, 200}, {-300, -200}, {300, 200}, {800, -200}},
                               .half_width = 150,
                               .end_half_width = 200,
                               .end_length = 200,
                               .amplitude = 30,
                               .wavelength = 500,
                               .period = 12};

bool is_simple(const std::vector<Vec2>& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (intersects(Segment{ring[i], ring[i + 1]}, Segment{ring[j], ring[(j + 1) % n]}))
        return false;
    }
  }
  return true;
}

TEST(Channel, outline_is_a_simple_ring_at_all_times) {
  EXPECT_TRUE(validate(winding).empty());
  for (double t = -3; t < 40; t += 0.71) {
    const auto ring = channel_outline(winding, t);
    EXPECT_TRUE(is_simple(ring)) << "t = " << t;
    EXPECT_GT(signed_area(ring), 0);
  }
}

TEST(Channel, block_is_solid_and_the_channel_free) {
  const Polygon block = channel_block(winding, 5);
  EXPECT_LT(signed_area(block.holes[0]), 0);
  for (const Vec2 p : winding.centre_line) {
    EXPECT_EQ(locate(block, p), Side::outside);
    EXPECT_GE(distance(p, block), 100);
  }
  EXPECT_EQ(locate(block, {-1099, -799}), Side::inside);
  EXPECT_EQ(locate(block, {-1101, 0}), Side::outside);
}

TEST(Channel, width_swings_by_the_amplitude_along_a_straight_one) {
  DeformingChannel straight{.centre_line = {{-900, 0}, {900, 0}},
                            .half_width = 200,
                            .end_half_width = 200,
                            .amplitude = 30,
                            .wavelength = 600,
                            .period = 20};
  double least = 1e9, greatest = 0;
  for (double t = 0; t < 20; t += 0.25) {
    const double d = distance(Vec2{0, 0}, channel_block(straight, t));
    least = std::min(least, d);
    greatest = std::max(greatest, d);
    EXPECT_LT(std::abs(distance(Vec2{0, 0}, channel_block(straight, t + 20)) - d), 1e-9);
  }
  EXPECT_NEAR(least, 170, 1);
  EXPECT_GT(greatest, 210);
}

TEST(Channel, ends_may_be_wider) {
  DeformingChannel wide{.centre_line = {{-700, 0}, {700, 0}},
                        .half_width = 100,
                        .end_half_width = 250,
                        .end_length = 300,
                        .amplitude = 0};
  const Polygon block = channel_block(wide, 0);
  EXPECT_NEAR(distance(Vec2{0, 0}, block), 100, 1e-6);
  EXPECT_NEAR(distance(Vec2{-700, 0}, block), 250, 30);
  EXPECT_EQ(locate(block, {-940, 0}), Side::outside);
  EXPECT_EQ(locate(block, {-960, 0}), Side::inside);
}

TEST(Channel, what_cannot_be_a_channel_is_named) {
  auto message = [](DeformingChannel c) -> std::string {
    const Issues issues = validate(c);
    EXPECT_LE(issues.size(), 1u);
    return issues.empty() ? "" : issues.begin()->text;
  };
  DeformingChannel c = winding;
  EXPECT_EQ(message(c), "");
  c.centre_line = {{5, 5}, {5, 5}};
  EXPECT_EQ(message(c), "centre_line_um needs two different points at least");
  c = winding;
  c.amplitude = 150;
  EXPECT_EQ(message(c), "amplitude_um is 150, closes the channel, whose half width is 150 µm");
  c = winding;
  c.centre_line = {{-400, 0}, {0, 0}, {-380, 20}};
  EXPECT_NE(message(c).find("too tight"), std::string::npos);
  c.centre_line = {{-900, 0}, {0, 0}, {500, 300}, {0, 650}, {-500, 300}, {-500, -500}};
  EXPECT_NE(message(c), "");
  c = winding;
  c.block_width = 1500;
  EXPECT_NE(message(c).find("leaves its block"), std::string::npos);
}

}  // namespace
}  // namespace microswarm
