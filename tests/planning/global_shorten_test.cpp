// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/global_input/global_shorten.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "microswarm/planning/global_input/global_search.hpp"
#include "microswarm/scenes/global_worlds.hpp"
#include "tests/planning/global_ends.hpp"

namespace microswarm::planning {
namespace {

using scenes::global_world;

TEST(GlobalShorten, ReachesTheSameGoalsWithFewerInputs) {
  std::size_t before = 0, after = 0;
  for (int world = 1; world <= scenes::global_worlds; ++world) {
    for (const ContactRule rule : {ContactRule::slide, ContactRule::stop}) {
      const Map map = scenes::global_world(world);
      Rng rng(1, Purpose::planner);
      const GlobalSearchParams params{.contact = rule};
      const GlobalPlan found =
          global_search(map, starts(2), goals(2), params, rng, Stop(std::chrono::seconds(20))).plan;
      if (found.status != Status::solved) continue;
      const GlobalPlan brief = shortened(map, found, goals(2), {.contact = rule});
      ASSERT_EQ(brief.configurations.size(), brief.inputs.size() + 1);
      EXPECT_LE(brief.inputs.size(), found.inputs.size());
      EXPECT_EQ(brief.status, Status::solved);
      before += found.inputs.size();
      after += brief.inputs.size();
      // An independent replay ends at the goals.
      const RobotStepper stepper = input_stepper(map, params.robostep);
      for (std::size_t i = 0; i < 2; ++i) {
        PointF p = stepper.relative(starts(2)[i]);
        for (std::size_t k = 0; k < brief.inputs.size(); ++k) {
          p = stepper.moved(p, {float(brief.inputs[k].x), float(brief.inputs[k].y)}, rule);
          const PointF q = stepper.relative(brief.configurations[k + 1][i]);
          ASSERT_TRUE(p.x == q.x && p.y == q.y) << "input " << k;
        }
        EXPECT_LE(distance(stepper.faces().origin() + Vec2{double(p.x), double(p.y)}, goals(2)[i]),
                  params.goal_tolerance + 1e-3);
      }
      // Nothing more can be left out of it.
      const GlobalPlan again = shortened(map, brief, goals(2), {.contact = rule});
      EXPECT_EQ(again.inputs, brief.inputs);
    }
  }
  EXPECT_GT(before, 0u);
  EXPECT_LT(after, before);
}

TEST(GlobalShorten, LeavesDetoursOut) {
  const Map map = scenes::global_world(1);
  GlobalPlan plan{Status::solved, {}, {{{100, 100}}}, 0};
  for (const Vec2 u : {Vec2{5, 0}, Vec2{0, 5}, Vec2{-5, 0}, Vec2{0, -5}, Vec2{5, 0}, Vec2{5, 0}}) {
    plan.inputs.push_back(u);
    plan.configurations.push_back({plan.configurations.back()[0] + u});
  }
  const std::vector<Vec2> goal{{110, 100}};
  const GlobalPlan brief = shortened(map, plan, goal, {.goal_tolerance = 1});
  ASSERT_EQ(brief.inputs.size(), 2u);
  EXPECT_LE(brief.worst, 1e-4);
}

TEST(GlobalShorten, AnUnsolvedPlanStaysAsItIs) {
  const Map map = scenes::global_world(1);
  const GlobalPlan plan{Status::node_limit, {{5, 0}}, {{{100, 100}}, {{105, 100}}}, 50};
  const std::vector<Vec2> goal{{200, 100}};
  EXPECT_EQ(shortened(map, plan, goal, {}).inputs, plan.inputs);
  EXPECT_EQ(shortened(map, plan, goal, {}).status, Status::node_limit);
}

}  // namespace
}  // namespace microswarm::planning
