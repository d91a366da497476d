// SPDX-License-Identifier: Apache-2.0
// Aggregation [gather] in a maze, and on the vessel masks of CHASE_DB1, which are not part of the
// project.
#include <gtest/gtest.h>

#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"
#include "tests/cases.hpp"
#include "tests/files.hpp"

namespace microswarm {
namespace {

/// Robots at random in a map gather at the goal, by each method.
void expect_gathered(const formats::MapSpec& map, Vec2 goal, double step, int robots) {
  experiment::Scenario s;
  s.map = map;
  s.robots.emplace().count = robots;
  s.robots->max_speed = 80;
  s.tick = step / s.robots->max_speed;
  s.time_limit = 100'000 * s.tick;
  s.goal = goal;
  s.goal_tolerance = 10 * step;
  navigation::AggregationParams params;
  params.scale = step;
  for (const navigation::Aggregation method :
       {navigation::Aggregation::divide_and_conquer, navigation::Aggregation::heuristic}) {
    if (test::sanitized && method == navigation::Aggregation::heuristic)
      break;  // steps in the same map
    params.method = method;
    s.navigator = params;
    const World world = experiment::build_world(experiment::load_scene(s, {}));
    EXPECT_TRUE(validate(s, world).empty());
    EXPECT_EQ(experiment::simulate(s, world).status, Status::solved);
  }
}

// The goal is a dead end in both.
TEST(GatherSample, RobotsInAMazeComeTogether) {
  expect_gathered(formats::guess_map_spec(test::sample_folder() / "maze.pgm", 1.0), {28, 12}, 0.8,
                  test::cases(48));
}

TEST(Gather, RobotsAnywhereInARealVesselMaskComeTogether) {
  const std::filesystem::path mask = test::data_folder() / "vessels" / "CHASE_09L_mask_obs1.png";
  if (!std::filesystem::exists(mask)) GTEST_SKIP() << "no " << mask;
  expect_gathered(formats::guess_map_spec(mask, 6.0), {234, 3217}, 4, test::cases(48));
}

}  // namespace
}  // namespace microswarm
