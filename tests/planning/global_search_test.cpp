// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/global_input/global_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/scenes/global_worlds.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "tests/cases.hpp"
#include "tests/planning/global_ends.hpp"

namespace microswarm::planning {
namespace {

using scenes::global_world;

GlobalSearch search(int world, std::size_t n, const GlobalSearchParams& params = {},
                    std::uint64_t seed = 1, const Stop& stop = {}) {
  Rng rng(seed, Purpose::planner);
  return global_search(scenes::global_world(world), starts(n), goals(n), params, rng, stop);
}

/// Every configuration is where the stepper brings the one before, to the bits.
void expect_replays(const Map& map, const GlobalPlan& plan, std::span<const Vec2> from,
                    std::span<const Vec2> to, const GlobalSearchParams& params) {
  const RobotStepper stepper = input_stepper(map, params.robostep);
  ASSERT_EQ(plan.configurations.size(), plan.inputs.size() + 1);
  for (std::size_t i = 0; i < from.size(); ++i)
    EXPECT_LT(distance(plan.configurations[0][i], from[i]), 1e-4);
  for (std::size_t k = 0; k < plan.inputs.size(); ++k) {
    const PointF move{static_cast<float>(plan.inputs[k].x), static_cast<float>(plan.inputs[k].y)};
    for (std::size_t i = 0; i < from.size(); ++i) {
      const PointF p =
          stepper.moved(stepper.relative(plan.configurations[k][i]), move, params.contact);
      const PointF q = stepper.relative(plan.configurations[k + 1][i]);
      ASSERT_TRUE(p.x == q.x && p.y == q.y) << "input " << k << " robot " << i;
      ASSERT_TRUE(map.is_free(plan.configurations[k + 1][i], 0));
    }
  }
  double worst = 0;
  for (std::size_t i = 0; i < to.size(); ++i)
    worst = std::max(worst, distance(plan.configurations.back()[i], to[i]));
  EXPECT_NEAR(plan.worst, worst, 1e-3);
  EXPECT_EQ(plan.status == Status::solved, plan.worst <= params.goal_tolerance);
}

TEST(GlobalSearch, SolvesWhatThePlainTreeDoesNot) {
  for (int world = 1; world <= scenes::global_worlds; ++world) {
    for (std::size_t n = 1; n <= 3; ++n) {
      const GlobalSearch found = search(world, n);
      ASSERT_EQ(found.plan.status, Status::solved) << "Env " << world << ", " << n << " robots";
      expect_replays(scenes::global_world(world), found.plan, starts(n), goals(n), {});
    }
  }
  EXPECT_EQ(search(2, 4).plan.status, Status::solved);
  EXPECT_EQ(search(3, 4).plan.status, Status::solved);
}

TEST(GlobalSearch, SolvesWithRobotsThatStopAtWalls) {
  GlobalSearchParams params;
  params.contact = ContactRule::stop;
  params.directions = 16;
  const GlobalSearch found = search(1, 2, params);
  ASSERT_EQ(found.plan.status, Status::solved);
  expect_replays(scenes::global_world(1), found.plan, starts(2), goals(2), params);
}

TEST(GlobalSearch, EveryPlanReplaysInRandomWorlds) {
  Rng rng(4, Purpose::scene);
  for (int k = 0; k < test::cases(20); ++k) {
    const scenes::RawWorld world = scenes::random_world(k % scenes::random_kinds, rng);
    const Map map(world.bounds, world.walls, world.discs);
    std::vector<Vec2> from, to;
    for (int i = 0; i < 2; ++i) {
      from.push_back(scenes::random_free_point(world, 1, rng));
      to.push_back(scenes::random_free_point(world, 1, rng));
    }
    const GlobalSearchParams params{.robostep = 10, .max_nodes = 3000};
    Rng planner(static_cast<std::uint64_t>(k), Purpose::planner);
    const GlobalSearch found = global_search(map, from, to, params, planner);
    expect_replays(map, found.plan, from, to, params);
  }
}

TEST(GlobalSearch, SameSeedSameBits) {
  const GlobalSearch a = search(4, 3, {}, 5);
  const GlobalSearch b = search(4, 3, {}, 5);
  const GlobalSearch c = search(4, 3, {}, 6);
  EXPECT_EQ(a.plan.inputs, b.plan.inputs);
  EXPECT_EQ(a.plan.configurations, b.plan.configurations);
  EXPECT_EQ(a.counts.samples, b.counts.samples);
  EXPECT_NE(a.plan.inputs, c.plan.inputs);
}

TEST(GlobalSearch, EndsAtItsLimitsAndWhenTold) {
  const GlobalSearch few = search(4, 4, {.max_nodes = 500});
  EXPECT_EQ(few.plan.status, Status::node_limit);
  EXPECT_LT(few.counts.samples, 1000u);
  EXPECT_GE(few.plan.configurations.size(), 1u);
  const std::atomic<bool> flag{true};
  EXPECT_EQ(search(4, 4, {}, 1, Stop(&flag)).plan.status, Status::stopped);
  EXPECT_EQ(search(4, 4, {}, 1, Stop(std::chrono::milliseconds(5))).plan.status,
            Status::time_limit);
}

TEST(GlobalSearch, AClosedRoomIsLeftUnsolved) {
  const Map map({{0, 0}, {100, 100}}, {scenes::rectangle({{45, 0}, {55, 100}})});
  const std::vector<Vec2> from{{10, 10}}, to{{90, 90}};
  Rng rng(1, Purpose::planner);
  const auto found = global_search(map, from, to, {.goal_tolerance = 5, .max_nodes = 20'000}, rng);
  EXPECT_EQ(found.plan.status, Status::node_limit);
}

TEST(GlobalSearch, RobotsThatHaveMetAreNotParted) {
  const std::vector<Vec2> from{{100, 200}, {100, 200}}, far{{120, 200}, {200, 300}};
  Rng rng(1, Purpose::planner);
  const auto found = global_search(scenes::global_world(1), from, far, {.max_nodes = 20'000}, rng);
  EXPECT_EQ(found.plan.status, Status::node_limit);
  EXPECT_LT(found.counts.samples, 1000u);
  ASSERT_EQ(found.plan.configurations.size(), 1u);
  const std::vector<Vec2> near{{200, 300}, {220, 300}};
  EXPECT_EQ(global_search(scenes::global_world(1), from, near, {}, rng).plan.status,
            Status::solved);
}

TEST(GlobalSearch, SaysWhatIsWrong) {
  const Map map = scenes::global_world(1);
  Rng rng(1, Purpose::planner);
  const auto status = [&](std::vector<Vec2> from, std::vector<Vec2> to) {
    return global_search(map, from, to, {.max_nodes = 100}, rng).plan.status;
  };
  EXPECT_EQ(status({{160, 200}}, {{100, 100}}), Status::start_blocked);
  EXPECT_EQ(status({{100, 200}}, {{20, 100}}), Status::goal_blocked);
  EXPECT_EQ(status({{100, 200}}, {{100, 210}}), Status::solved);
  EXPECT_THROW(status({}, {}), InputError);
  EXPECT_THROW(status({{100, 200}}, {}), InputError);
  EXPECT_THROW(status({{100, 200}}, {{100, 100}, {100, 120}}), InputError);
}

}  // namespace
}  // namespace microswarm::planning
