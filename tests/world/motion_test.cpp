// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/motion.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/angles.hpp"
#include "microswarm/core/rng.hpp"

namespace microswarm {
namespace {

std::shared_ptr<const Samples> samples(std::vector<double> times, std::vector<Vec2> points) {
  return std::make_shared<Samples>(Samples{std::move(times), std::move(points)});
}

const std::vector<Vec2> corners{{0, 0}, {300, 0}, {300, 0}, {300, 400}, {-100, 400}};

std::vector<Motion> all_motions() {
  return {Still{{3, 4}, 0.5},
          Straight{{10, 20}, {-7, 3}},
          HarmonicLine{{100, 100}, {80, -60}, 12.5, 0.3},
          HarmonicArc{{0, 0}, 250, 1.0, 0.8, 9, -0.2},
          Waypoints{corners, 35, AtEnd::stay},
          Waypoints{corners, 35, AtEnd::back},
          Waypoints{corners, 35, AtEnd::loop},
          Waypoints{{{5, 5}}, 35, AtEnd::loop},
          Track{"f.csv", "1", samples({0, 1, 4, 4.5}, {{0, 0}, {10, 0}, {10, 60}, {0, 60}})}};
}

TEST(Motion, is_never_faster_than_its_top_speed) {
  Rng rng(1, Purpose::test);
  for (const Motion& motion : all_motions()) {
    const double top = top_speed(motion);
    for (int i = 0; i < 3000; ++i) {
      const double t = rng.uniform(-10, 60);
      const double dt = std::pow(10.0, rng.uniform(-4, 1));
      const Placement a = placement(motion, t);
      const Placement b = placement(motion, t + dt);
      if (!a.present || !b.present) continue;
      EXPECT_LE(distance(a.pose.position, b.pose.position), top * dt + 1e-9);
      EXPECT_LE(turn_between(a.pose.heading, b.pose.heading), top_turning(motion) * dt + 1e-9);
      EXPECT_LE(norm(a.velocity), top * (1 + 1e-12));
    }
  }
}

TEST(Motion, velocity_is_the_derivative_of_position) {
  Rng rng(2, Purpose::test);
  for (const Motion& motion : all_motions()) {
    int bends = 0;
    for (int i = 0; i < 1000; ++i) {
      const double t = rng.uniform(0.1, 40);
      const double dt = 1e-5;
      const Placement a = placement(motion, t - dt);
      const Placement b = placement(motion, t + dt);
      if (!a.present || !b.present) continue;
      const Vec2 slope = (b.pose.position - a.pose.position) / (2 * dt);
      bends += distance(slope, placement(motion, t).velocity) > 1e-3 ? 1 : 0;
    }
    EXPECT_LE(bends, 2);  // a corner may fall between t − dt and t + dt
  }
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

TEST(Motion, same_time_same_bits) {
  for (const Motion& motion : all_motions()) {
    for (double t = -1; t < 30; t += 0.1) {
      EXPECT_EQ(placement(motion, t).pose, placement(Motion(motion), t).pose);
    }
  }
}

}  // namespace
}  // namespace microswarm
