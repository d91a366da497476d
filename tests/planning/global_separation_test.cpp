// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/global_input/global_separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/planning/global_input/global_rrt.hpp"
#include "microswarm/planning/global_input/global_search.hpp"
#include "microswarm/planning/global_input/global_shorten.hpp"
#include "microswarm/scenes/global_worlds.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "tests/cases.hpp"
#include "tests/planning/global_ends.hpp"

namespace microswarm::planning {
namespace {

using scenes::global_world;

double min_of(const std::vector<PointF>& robots) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < robots.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least, std::hypot(double(robots[i].x) - double(robots[j].x),
                                         double(robots[i].y) - double(robots[j].y)));
  return least;
}

/// Oracle: the least distance between two robots at many moments of a move.
double min_on(const RobotStepper& stepper, const std::vector<PointF>& from, PointF move,
              ContactRule rule, int moments) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<PointF> now(from.size());
  for (int k = 0; k <= moments; ++k) {
    const float share = float(k) / float(moments);
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (rule == ContactRule::reject) {
        const PointF end = stepper.moved(from[i], move, rule);
        now[i] = {from[i].x + share * (end.x - from[i].x), from[i].y + share * (end.y - from[i].y)};
      } else {
        now[i] = stepper.moved(from[i], {share * move.x, share * move.y}, rule);
      }
    }
    least = std::min(least, min_of(now));
  }
  return least;
}

TEST(GlobalSeparation, HoldsOnlyWhereNoMomentOfTheMoveIsTooNear) {
  constexpr double step = 8;
  constexpr double slack = 1e-3;
  int held = 0, broken = 0, refused_too_much = 0;
  Rng rng(3, Purpose::test);
  for (const ContactRule rule : {ContactRule::slide, ContactRule::stop, ContactRule::reject}) {
    for (int world = 1; world <= scenes::global_worlds; ++world) {
      const Map map = scenes::global_world(world);
      const RobotStepper stepper = input_stepper(map, step);
      for (int k = 0; k < test::cases(2000); ++k) {
        // Two robots near each other and near walls.
        Vec2 p, q;
        do {
          p = {rng.uniform(50, 350), rng.uniform(50, 350)};
          q = p + Vec2{rng.uniform(-9, 9), rng.uniform(-9, 9)};
        } while (!map.is_free(p, 0.1) || !map.is_free(q, 0.1) || map.clearance(p) > 10);
        const std::vector<PointF> from{stepper.relative(p), stepper.relative(q)};
        const double least = rng.uniform(0.5, 8);
        if (min_of(from) < least) continue;
        const std::vector<PointF> moves = input_moves(16, step);
        const PointF move = moves[rng.below(16)];
        std::vector<PointF> to;
        for (const PointF r : from) to.push_back(stepper.moved(r, move, rule));
        const double truth = min_on(stepper, from, move, rule, 400);
        const bool holds = GlobalSeparation(stepper, rule, least).holds(from, to, move);
        if (holds) {
          EXPECT_GT(truth, least - slack);
        }
        held += holds;
        broken += truth < least;
        refused_too_much += !holds && truth > least + step / 64;
      }
    }
  }
  EXPECT_GT(held, test::cases(1000));
  EXPECT_GT(broken, test::cases(100));
  EXPECT_EQ(refused_too_much, 0);
}

TEST(GlobalSeparation, NoneHoldsAlways) {
  const RobotStepper stepper = input_stepper(scenes::global_world(1), 5);
  const std::vector<PointF> same(2);
  EXPECT_TRUE(GlobalSeparation(stepper, ContactRule::slide, 0).holds(same));
  EXPECT_TRUE(GlobalSeparation(stepper, ContactRule::slide, 0).holds(same, same, {5, 0}));
  EXPECT_FALSE(GlobalSeparation(stepper, ContactRule::slide, 1).holds(same));
}

TEST(GlobalSeparation, ATreeKeepsIt) {
  constexpr double least = 30;
  const Map map = scenes::global_world(1);
  const GlobalRrtParams plain{.max_nodes = 3000, .stop_at_first = false};
  GlobalRrtParams apart = plain;
  apart.separation = least;
  Rng a(1, Purpose::planner), b(1, Purpose::planner);
  const GlobalRrt free_tree = global_rrt(map, starts(3), {}, plain, a);
  const GlobalTree tree = global_rrt(map, starts(3), {}, apart, b).tree;
  EXPECT_EQ(tree.separation, least);
  const RobotStepper stepper = input_stepper(map, plain.robostep);
  const auto robots = [&](const GlobalTree& t, std::uint32_t node) {
    std::vector<PointF> all;
    for (const Vec2 p : t.positions(node)) all.push_back(stepper.relative(p));
    return all;
  };
  bool comes_nearer = false;
  for (std::uint32_t node = 1; node < tree.size(); ++node) {
    const std::vector<PointF> from = robots(tree, tree.parents[node]);
    ASSERT_GT(min_on(stepper, from, tree.moves[tree.inputs[node]], tree.contact, 20), least - 1e-3);
  }
  for (std::uint32_t node = 1; node < free_tree.tree.size(); ++node)
    comes_nearer |= min_of(robots(free_tree.tree, node)) < least;
  EXPECT_TRUE(comes_nearer);
  EXPECT_EQ(tree.size(), 3000u);
}

TEST(GlobalSeparation, PlansKeepIt) {
  for (const double least : {10.0, 25.0}) {
    for (int world = 1; world <= scenes::global_worlds; ++world) {
      const Map map = scenes::global_world(world);
      const GlobalSearchParams params{.separation = least};
      Rng rng(1, Purpose::planner);
      const GlobalSearch found =
          global_search(map, starts(2), goals(2), params, rng, Stop(std::chrono::seconds(20)));
      ASSERT_EQ(found.plan.status, Status::solved) << world;
      const RobotStepper stepper = input_stepper(map, params.robostep);
      const GlobalPlan brief = shortened(map, found.plan, goals(2), {.separation = least});
      for (const GlobalPlan* plan : {&found.plan, &brief}) {
        EXPECT_LE(plan->worst, params.goal_tolerance);
        for (std::size_t k = 0; k < plan->inputs.size(); ++k) {
          std::vector<PointF> from;
          for (const Vec2 p : plan->configurations[k]) from.push_back(stepper.relative(p));
          const PointF move{float(plan->inputs[k].x), float(plan->inputs[k].y)};
          ASSERT_GT(min_on(stepper, from, move, params.contact, 20), least - 1e-3);
        }
      }
    }
  }
}

TEST(GlobalSeparation, SaysWhatIsWrong) {
  const Map map = scenes::global_world(1);
  Rng rng(1, Purpose::planner);
  const std::vector<Vec2> near{{100, 200}, {100, 204}}, far{{100, 200}, {100, 260}};
  const auto status = [&](const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
    const GlobalSearchParams params{.goal_tolerance = 5, .separation = 20, .max_nodes = 100};
    return global_search(map, from, to, params, rng).plan.status;
  };
  EXPECT_EQ(status(near, far), Status::start_blocked);
  EXPECT_EQ(status(far, near), Status::goal_blocked);
  EXPECT_EQ(status(far, far), Status::solved);
}

}  // namespace
}  // namespace microswarm::planning
