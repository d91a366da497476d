// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/predictive/time_field.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::navigation {
namespace {

constexpr double field_speed = 80;
constexpr double field_radius = 50;

/// A field around the origin with the goal far to the right.
struct Made {
  TimeField field{field_speed, 6, 0.5};
  Vec2 goal{1000, 0};

  void solve(std::span<const ConvexOutline> outlines, std::span<const PredictedBody> ahead) {
    field.begin(
        {}, {goal, 20}, [](Vec2) { return 0.0F; },
        [&](Vec2 p) { return static_cast<float>(distance(p, goal) / field_speed); });
    field.solve(outlines, ahead, field_radius, {});
  }
};

TEST(TimeField, InTheOpenTheCostIsTheWay) {
  Made made;
  made.solve({}, {});
  for (int k = 0; k < 16; ++k) {
    const Vec2 p = 30 * unit_vector(2 * pi * k / 16);
    const double way = distance(p, made.goal) / field_speed;
    EXPECT_GE(made.field.cost(1, p), 0.97 * way);
    EXPECT_LE(made.field.cost(1, p), 1.03 * way);
  }
}

TEST(TimeField, TheGoalEndsIt) {
  Made made;
  made.goal = {120, 0};
  made.solve({}, {});
  EXPECT_EQ(made.field.cost(1, {120, 0}), 0);
  EXPECT_NEAR(made.field.cost(1, {0, 0}), 120 / field_speed, 0.6);
}

TEST(TimeField, ADiscThatComesCostsNothingBesideItsWay) {
  Made made;
  ConvexOutline disc;
  disc.radius = 60;
  std::vector<PredictedBody> ahead;
  for (int s = 0; s < 2 * made.field.steps(); ++s)
    ahead.push_back({.centre = {600 - 200 * made.field.time_at(s), 0}});
  made.solve(std::span(&disc, 1), ahead);
  const double on_its_way = made.field.cost(1, {40, 0});
  EXPECT_GT(on_its_way, 960 / field_speed + 0.5);
  EXPECT_LT(on_its_way, 960 / field_speed + 8) << "there is time to step aside";
  // Two seconds later it has just passed: in its place now, but not then.
  EXPECT_LT(made.field.cost(6, {100, 170}), distance({100, 170}, made.goal) / field_speed + 0.5);
}

TEST(TimeField, OutlinesAreNeverTooSmall) {
  ConvexOutliner outliner;
  ConvexOutline outline;
  const std::vector<Vec2> kite{{-70, 0}, {0, -30}, {90, 0}, {0, 30}};
  outliner.take({.shape = Polygon{kite, {}}}, outline);
  EXPECT_EQ(outline.edges.size(), 4u);
  EXPECT_NEAR(outliner.hollow_share(), 0, 1e-12);
  for (int k = 0; k < 200; ++k) {
    const Vec2 p = (20.0 + k) * unit_vector(0.1 * k);
    const double exact = distance(p, Polygon{kite, {}});
    EXPECT_LE(outline.distance_at(p - outline.centre), exact + 1e-9);
  }
  outliner.take({.shape = Polygon{{{0, 0}, {90, 0}, {90, 10}, {10, 10}, {10, 90}, {0, 90}}, {}}},
                outline);
  EXPECT_EQ(outline.edges.size(), 5u);
  EXPECT_GT(outliner.hollow_share(), 0.5);
}

}  // namespace
}  // namespace microswarm::navigation
