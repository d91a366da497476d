// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/motion.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

std::shared_ptr<const Samples> samples(std::vector<double> times, std::vector<Vec2> points) {
  return std::make_shared<Samples>(Samples{std::move(times), std::move(points)});
}

TEST(Motion, harmonic_ones_repeat_with_their_period) {
  const HarmonicLine line{{100, 100}, {80, -60}, 12.5, 0.3};
  const HarmonicArc arc{{0, 0}, 250, 1.0, 0.8, 9, -0.2};
  for (double t = -20; t < 20; t += 0.37) {
    for (const int n : {1, -3, 100000}) {
      EXPECT_LT(distance(placement(line, t).pose.position,
                         placement(line, t + n * line.period).pose.position),
                1e-6);
      EXPECT_LT(distance(placement(arc, t).pose.position,
                         placement(arc, t + n * arc.period).pose.position),
                1e-6);
    }
  }
  EXPECT_EQ(placement(HarmonicLine{{1, 2}, {30, 0}, 8, 0}, 2).pose.position, (Vec2{31, 2}));
  EXPECT_NEAR(distance(placement(arc, 3.3).pose.position, Vec2{0, 0}), 250, 1e-9);
  EXPECT_EQ(top_speed(HarmonicLine{{}, {30, 40}, 10, 0}), 100 * pi / 10);
}

TEST(Motion, waypoints_stay_turn_back_or_loop) {
  const std::vector<Vec2> points{{0, 0}, {100, 0}, {100, 100}};
  auto at = [&](AtEnd end, double t) {
    return placement(Waypoints{points, 10, end}, t).pose.position;
  };
  for (const AtEnd end : {AtEnd::stay, AtEnd::back, AtEnd::loop}) {
    EXPECT_EQ(at(end, -5), (Vec2{0, 0}));
    EXPECT_EQ(at(end, 0), (Vec2{0, 0}));
    EXPECT_EQ(at(end, 5), (Vec2{50, 0}));
    EXPECT_EQ(at(end, 15), (Vec2{100, 50}));
  }
  EXPECT_EQ(at(AtEnd::stay, 25), (Vec2{100, 100}));
  EXPECT_EQ(placement(Waypoints{points, 10, AtEnd::stay}, 25).velocity, (Vec2{0, 0}));
  EXPECT_EQ(at(AtEnd::back, 25), (Vec2{100, 50}));
  EXPECT_EQ(at(AtEnd::back, 45), (Vec2{50, 0}));
  EXPECT_LT(distance(at(AtEnd::loop, 20 + 5 * std::sqrt(2.0)), Vec2{50, 50}), 1e-9);
  EXPECT_LT(distance(at(AtEnd::loop, 1000 * (20 + 10 * std::sqrt(2.0)) + 5), Vec2{50, 0}), 1e-6);
  EXPECT_FALSE(placement(Waypoints{}, 0).present);
  EXPECT_EQ(placement(Waypoints{points, 0, AtEnd::back}, 9).pose.position, (Vec2{0, 0}));
}

TEST(Motion, a_track_is_absent_outside_its_times) {
  const Track track{"f.csv", "7", samples({2, 3, 5}, {{0, 0}, {10, 0}, {10, 40}})};
  EXPECT_FALSE(placement(track, 1.999).present);
  EXPECT_FALSE(placement(track, 5.001).present);
  EXPECT_EQ(placement(track, 2).pose.position, (Vec2{0, 0}));
  EXPECT_EQ(placement(track, 2.5).pose.position, (Vec2{5, 0}));
  EXPECT_EQ(placement(track, 4).pose.position, (Vec2{10, 20}));
  EXPECT_EQ(placement(track, 4).velocity, (Vec2{0, 20}));
  EXPECT_EQ(placement(track, 5).pose.position, (Vec2{10, 40}));
  EXPECT_EQ(top_speed(track), 20);
  EXPECT_FALSE(placement(Track{}, 0).present);
  const Track once{"f.csv", "7", samples({2}, {{1, 1}})};
  EXPECT_TRUE(placement(once, 2).present);
  EXPECT_FALSE(placement(once, 2.1).present);
}

}  // namespace
}  // namespace microswarm
