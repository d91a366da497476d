// SPDX-License-Identifier: Apache-2.0
// Laws that every motion of an obstacle keeps.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/shapes.hpp"
#include "microswarm/world/obstacles/motion.hpp"
#include "tests/laws/fields_laws.hpp"

namespace microswarm {
namespace {

struct MotionCase {
  std::string name;
  Motion motion;
  std::optional<Box> extent;  ///< that it never leaves, where it has one
};

void PrintTo(const MotionCase& c, std::ostream* os) { *os << c.name; }

class MotionLaws : public testing::TestWithParam<MotionCase> {
 protected:
  const Motion& motion() const { return GetParam().motion; }
};

// Near moments too: there is no jump.
TEST_P(MotionLaws, NeverFasterThanItsTopSpeed) {
  const double top = top_speed(motion());
  Rng rng(1, Purpose::test);
  for (int i = 0; i < 5000; ++i) {
    const double t = rng.uniform(-10, 60);
    const double dt = std::pow(10.0, rng.uniform(-9, 1.5));
    const Placement a = placement(motion(), t);
    const Placement b = placement(motion(), t + dt);
    if (!a.present || !b.present) continue;
    ASSERT_LE(distance(a.pose.position, b.pose.position), top * dt + 1e-9) << t << ", " << dt;
    ASSERT_LE(turn_between(a.pose.heading, b.pose.heading), top_turning(motion()) * dt + 1e-9);
    ASSERT_LE(norm(a.velocity), top * (1 + 1e-12));
  }
}

TEST_P(MotionLaws, TopSpeedIsReached) {
  const double top = top_speed(motion());
  double fastest = 0;
  for (double t = 0; t < 120; t += 0.01) {
    const Placement p = placement(motion(), t);
    if (p.present) fastest = std::max(fastest, norm(p.velocity));
  }
  EXPECT_GE(fastest, 0.999 * top);
}

TEST_P(MotionLaws, VelocityIsTheDerivativeOfPosition) {
  Rng rng(2, Purpose::test);
  int bends = 0;
  for (int i = 0; i < 1000; ++i) {
    const double t = rng.uniform(0.1, 40);
    constexpr double dt = 1e-5;
    const Placement a = placement(motion(), t - dt);
    const Placement b = placement(motion(), t + dt);
    if (!a.present || !b.present) continue;
    const Vec2 slope = (b.pose.position - a.pose.position) / (2 * dt);
    bends += distance(slope, placement(motion(), t).velocity) > 1e-3 ? 1 : 0;
  }
  EXPECT_LE(bends, 2);  // a corner may fall between t − dt and t + dt
}

TEST_P(MotionLaws, PureInTime) {
  const Motion copy = motion();
  std::vector<Placement> forwards;
  for (int i = 0; i < 300; ++i) forwards.push_back(placement(motion(), 0.13 * i - 2));
  for (int i = 299; i >= 0; --i) {
    const Placement& was = forwards[static_cast<std::size_t>(i)];
    const Placement is = placement(copy, 0.13 * i - 2);
    EXPECT_EQ(is.present, was.present);
    EXPECT_EQ(is.pose, was.pose);
    EXPECT_EQ(is.velocity, was.velocity);
  }
}

TEST_P(MotionLaws, FiniteAtAnyTime) {
  for (const double t : {-1e9, -1.0, 0.0, 1e-300, 1e6, 1e9}) {
    const Placement p = placement(motion(), t);
    EXPECT_TRUE(is_finite(p.pose.position) && std::isfinite(p.pose.heading) &&
                is_finite(p.velocity))
        << t;
  }
}

TEST_P(MotionLaws, StaysWithinItsExtent) {
  if (!GetParam().extent) return;
  const Box extent = GetParam().extent->grown(1e-9);
  Box seen;
  for (double t = -20; t < 200; t += 0.01) {
    const Placement p = placement(motion(), t);
    if (!p.present) continue;
    ASSERT_TRUE(extent.contains(p.pose.position)) << t;
    seen.include(p.pose.position);
  }
  EXPECT_LE(seen.width(), extent.width());
  EXPECT_GE(seen.width(), 0.99 * GetParam().extent->width());
  EXPECT_GE(seen.height(), 0.99 * GetParam().extent->height());
}

TEST_P(MotionLaws, ReadsBack) { laws::expect_reads_back(motion()); }
TEST_P(MotionLaws, LimitsAreKept) {
  const bool has_some = !std::holds_alternative<Track>(motion());
  EXPECT_EQ(laws::expect_limits_are_kept(motion()) > 0, has_some);
}

std::vector<MotionCase> motion_cases() {
  const std::vector<Vec2> corners{{0, 0}, {300, 0}, {300, 0}, {300, 400}, {-100, 400}};
  const Box around{{-100, 0}, {300, 400}};
  const auto samples =
      std::make_shared<Samples>(Samples{{0, 1, 4, 4.5}, {{0, 0}, {10, 0}, {10, 60}, {0, 60}}});
  return {
      {"Still", Still{{3, 4}, 0.5}, Box{{3, 4}, {3, 4}}},
      {"Straight", Straight{{10, 20}, {-7, 3}}, std::nullopt},
      {"HarmonicLine", HarmonicLine{{100, 100}, {80, -60}, 12.5, 0.3}, Box{{20, 40}, {180, 160}}},
      {"HarmonicArc", HarmonicArc{{0, 0}, 250, 0, pi, 9, -0.2}, Box{{-250, -250}, {250, 250}}},
      {"WaypointsStay", Waypoints{corners, 35, AtEnd::stay}, around},
      {"WaypointsBack", Waypoints{corners, 35, AtEnd::back}, around},
      {"WaypointsLoop", Waypoints{corners, 35, AtEnd::loop}, around},
      {"WaypointsOne", Waypoints{{{5, 5}}, 35, AtEnd::loop}, Box{{5, 5}, {5, 5}}},
      {"Track", Track{"f.csv", "1", samples}, Box{{0, 0}, {10, 60}}}};
}

INSTANTIATE_TEST_SUITE_P(All, MotionLaws, testing::ValuesIn(motion_cases()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace microswarm
