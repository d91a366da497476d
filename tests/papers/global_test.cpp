// SPDX-License-Identifier: Apache-2.0
// The task that came with the published program of [global], and a sample of its kind.
#include <gtest/gtest.h>

#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/planning/global_input/global_search.hpp"
#include "microswarm/scenes/global_tasks.hpp"
#include "tests/files.hpp"

namespace microswarm {
namespace {

/// A plan is found, and played it brings all robots to their goals.
void expect_all_come_home(const scenes::GlobalTask& task) {
  planning::GlobalSearchParams params;
  params.robostep = 2;
  params.goal_tolerance = 4;
  params.max_nodes = 100'000;
  Rng rng(1, Purpose::planner);
  const planning::GlobalPlan plan =
      planning::global_search(task.map, task.starts, task.goals, params, rng).plan;
  ASSERT_EQ(plan.status, Status::solved);
  std::vector<Vec2> positions = task.starts;
  const RobotStepper stepper = planning::input_stepper(task.map, params.robostep);
  for (const Vec2 input : plan.inputs)
    for (Vec2& p : positions) {
      const PointF moved =
          stepper.moved(stepper.relative(p), {float(input.x), float(input.y)}, ContactRule::slide);
      p = task.map.bounds().centre() +
          Vec2{static_cast<double>(moved.x), static_cast<double>(moved.y)};
    }
  for (std::size_t i = 0; i < positions.size(); ++i)
    EXPECT_LE(distance(positions[i], task.goals[i]), params.goal_tolerance + 1e-3) << i;
}

TEST(GlobalSample, TwoRobotsAmongVeins) {
  const auto file = test::sample_folder() / "veins.csv";
  expect_all_come_home({.name = "veins",
                        .map = *formats::load_map(formats::guess_map_spec(file)).map,
                        .starts = {{25, 30}, {25, 50}},
                        .goals = {{175, 30}, {175, 60}}});
}

TEST(Global, ThreeRobotsAmongThePublishedVeinsOfALeaf) {
  const auto data = test::data_folder();
  if (data.empty()) GTEST_SKIP() << "no folder MICROSWARM_DATA";
  const auto file = data / "paper_authors" / "global_leaf.csv";
  expect_all_come_home(scenes::leaf_task(*formats::load_map(formats::guess_map_spec(file)).map));
}

}  // namespace
}  // namespace microswarm
