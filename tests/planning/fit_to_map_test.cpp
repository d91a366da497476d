// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/path/fit_to_map.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "microswarm/planning/path/planners.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::planning {
namespace {

const IsGiven nothing = [](std::string_view) { return false; };
const IsGiven clearance_only = [](std::string_view key) { return key == "clearance_um"; };

/// One of every kind of planner.
template <std::size_t... I>
std::vector<PlannerParams> every_kind(std::index_sequence<I...>) {
  return {std::variant_alternative_t<I, PlannerParams>{}...};
}
const std::vector<PlannerParams> kinds =
    every_kind(std::make_index_sequence<std::variant_size_v<PlannerParams>>{});

/// Four rooms in a row, joined by doors on alternating sides; `unit` is a tenth of a room [µm].
scenes::RawWorld rooms(double unit) {
  scenes::RawWorld world;
  world.bounds = {{0, 0}, {43 * unit, 10 * unit}};
  for (int i = 0; i < 3; ++i) {
    const double x = 11.0 * i + 10;
    const double low = i % 2 == 0 ? 0.0 : 2.0, high = i % 2 == 0 ? 8.0 : 10.0;
    world.walls.push_back(
        scenes::rectangle({{x * unit, low * unit}, {(x + 1) * unit, high * unit}}));
  }
  return world;
}

template <class Params>
Params fit(const Map& map, Params params = {}, const IsGiven& is_given = nothing) {
  return std::get<Params>(fit_to_map(params, map, is_given));
}

TEST(FitToMap, LengthsGrowWithTheMapAndLimitsStay) {
  const Snapshot one = rooms(30).snapshot(), ten = rooms(300).snapshot();
  const DrrtStarParams a = fit<DrrtStarParams>(one.map()), b = fit<DrrtStarParams>(ten.map());
  EXPECT_NEAR(b.step, 10 * a.step, 1e-6 * b.step);
  EXPECT_NEAR(b.search_radius, 10 * a.search_radius, 1e-6 * b.search_radius);
  EXPECT_NEAR(b.detection_diameter, 10 * a.detection_diameter, 1e-6 * b.detection_diameter);
  EXPECT_NEAR(b.speed, 10 * a.speed, 1e-6 * b.speed);
  EXPECT_EQ(a.turn_radius, b.turn_radius);
  EXPECT_EQ(a.clearance, b.clearance);
  EXPECT_NEAR(a.max_nodes, b.max_nodes, 1);
  EXPECT_LE(b.goal_tolerance, DrrtStarParams{}.goal_tolerance);
  EXPECT_LT(fit<RrtParams>(rooms(3).snapshot().map()).goal_tolerance, 10);
}

TEST(FitToMap, WhatIsGivenStays) {
  const Snapshot big = rooms(3000).snapshot();
  const IsGiven given = [](std::string_view key) {
    return key == "step_um" || key == "max_iterations";
  };
  const auto fitted = fit<RrtStarParams>(big.map(), {}, given);
  const RrtStarParams usual;
  EXPECT_EQ(fitted.step, usual.step);
  EXPECT_EQ(fitted.max_iterations, usual.max_iterations);
  EXPECT_GT(fitted.search_radius, usual.search_radius);
  EXPECT_GT(fitted.max_nodes, usual.max_nodes);  // more of these steps fill the map
}

TEST(FitToMap, AMapWithoutSpaceChangesNothing) {
  scenes::RawWorld full = rooms(30);
  full.walls = {scenes::rectangle({{-10, -10}, {1e4, 1e4}})};
  EXPECT_EQ(fit<RrtParams>(full.snapshot().map()).step, RrtParams{}.step);
}

TEST(FitToMap, EveryPlannerCrossesMapsOfEverySize) {
  for (const double unit : {0.3, 30.0, 3000.0}) {
    const Snapshot world = rooms(unit).snapshot();
    for (PlannerParams params : kinds) {
      std::visit([&](auto& p) { p.clearance = 0.2 * unit; }, params);
      params = fit_to_map(params, world.map(), clearance_only);
      Rng rng(1, Purpose::planner);
      const Plan found = plan(world, {{unit, unit}, 0}, {42 * unit, unit}, params, rng);
      EXPECT_EQ(found.status, Status::solved) << params.index() << " at " << unit;
      EXPECT_LT(path_length(found), 100 * unit) << params.index();
    }
  }
}

/// Rooms of nine cells by nine with walls of one, and a door of one cell in each wall, somewhere.
scenes::RawWorld rooms_on_cells(Vec2 origin, double cell, int rooms) {
  Rng rng(7, Purpose::scene);
  scenes::RawWorld world;
  world.bounds = {origin, origin + cell * Vec2{10.0 * rooms, 10.0 * rooms}};
  const auto wall = [&](bool is_upright, double across, double from, double to) {
    const Vec2 lo = is_upright ? Vec2{across, from} : Vec2{from, across};
    const Vec2 hi = is_upright ? Vec2{across + 1, to} : Vec2{to, across + 1};
    world.walls.push_back(scenes::rectangle({origin + cell * lo, origin + cell * hi}));
  };
  for (int i = 1; i < rooms; ++i)
    for (int j = 0; j < rooms; ++j)
      for (const bool is_upright : {false, true}) {
        const double door = 10.0 * j + 1 + static_cast<double>(rng.below(8));
        wall(is_upright, 10.0 * i - 1, 10.0 * j, door);
        wall(is_upright, 10.0 * i - 1, door + 1, 10.0 * (j + 1));
      }
  return world;
}

template <class Params>
class FitToLattice : public testing::Test {};
using LatticeKinds = testing::Types<AStarParams, ThetaStarParams, RrtParams, RrtConnectParams>;
TYPED_TEST_SUITE(FitToLattice, LatticeKinds);

TYPED_TEST(FitToLattice, DoorsOfOneCellArePassed) {
  const Vec2 origin{-314.159, 27.1828};
  const Snapshot world = rooms_on_cells(origin, 100, 8).snapshot();
  for (const double keeps : {5.0, 40.0, 48.0}) {
    TypeParam params;
    params.clearance = keeps;
    params = fit(world.map(), params, clearance_only);
    const Pose2 start{origin + Vec2{210, 190}, 0};
    const Vec2 goal = origin + Vec2{7700, 7600};
    Rng rng(1, Purpose::planner);
    const Plan found = plan(world, start, goal, params, rng);
    ASSERT_EQ(found.status, Status::solved) << keeps;
    if constexpr (std::is_base_of_v<GridParams, TypeParam>) {
      const Plan best = plan(world, start, goal, ExactParams{.clearance = keeps}, rng);
      EXPECT_LT(path_length(found), 1.15 * path_length(best)) << keeps;
      EXPECT_LE(params.cell, 100 * (1 + 1e-9));
    }
    for (std::size_t i = 1; i < found.path.size(); ++i)
      EXPECT_TRUE(world.is_free(Segment{found.path[i - 1], found.path[i]}, keeps));
  }
}

// Two rooms with a thin wall between them, and a goal that is nearer to its other side than the
// tolerance of a wide map.
TEST(FitToMap, NoPathEndsOnTheOtherSideOfAWall) {
  scenes::RawWorld rooms{.bounds = {{0, 0}, {2000, 1000}}};
  rooms.walls = {scenes::rectangle({{999, 0}, {1001, 800}})};
  const Snapshot world = rooms.snapshot();
  for (const double keeps : {4.0, 8.0, 20.0})
    for (const double away : {1.0, 10.0, 30.0})
      for (PlannerParams params : kinds) {
        const Vec2 goal{1001 + away, 300};
        std::visit([&](auto& p) { p.clearance = keeps; }, params);
        params = fit_to_map(params, world.map(), clearance_only);
        // From afar, and along the wall.
        for (const Vec2 start : {Vec2{100, 300}, Vec2{975, 100}}) {
          Rng rng(1, Purpose::planner);
          const Plan found = plan(world, {start, 0}, goal, params, rng);
          const std::string which = fmt::format("{} {} {}", params.index(), keeps, away);
          ASSERT_EQ(found.status, Status::solved) << which;
          EXPECT_GT(found.path.back().x, 1001) << which;
        }
      }
}

TEST(FitToMap, WidePassagesHaveCoarseCellsAndUniformSamples) {
  const Snapshot world = rooms(3000).snapshot();  // lattice of 3000 µm, doors of two cells
  EXPECT_TRUE(fit<AStarParams>(world.map()).origin);
  EXPECT_EQ(fit<RrtParams>(world.map()).sample_pitch, 0);
  const auto one = [](std::string_view key) { return key == "cell_um"; };
  EXPECT_FALSE(fit<AStarParams>(world.map(), {}, one).origin);
}

TEST(FitToMap, FreePolygonsHaveNoLattice) {
  Rng rng(1, Purpose::scene);
  const Snapshot world = scenes::cluttered(rng).snapshot();
  EXPECT_FALSE(fit<ThetaStarParams>(world.map()).origin);
  EXPECT_EQ(fit<RrtStarParams>(world.map()).sample_pitch, 0);
}

TEST(FitToMap, TheLimitThatEndedASearchIsNamed) {
  const RrtParams params;
  EXPECT_EQ(limit_text(params, {.iterations = 20}), "planner.max_nodes is 5000");
  EXPECT_EQ(limit_text(params, {.iterations = 100'000}), "planner.max_iterations is 100000");
  AStarParams small;
  small.max_nodes = 7;
  EXPECT_EQ(limit_text(small, {.iterations = 7}), "planner.max_nodes is 7");
  small.cell = 1e-3;
  EXPECT_EQ(limit_text(small, {}), "planner.cell_um is 0.001, too small for this map");
}

}  // namespace
}  // namespace microswarm::planning
