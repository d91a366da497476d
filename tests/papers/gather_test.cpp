// SPDX-License-Identifier: Apache-2.0
// Aggregation [gather] on the vessel masks of CHASE_DB1, which are not part of the project.
#include <gtest/gtest.h>

#include "microswarm/experiment/run/run.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/formats/map_file.hpp"
#include "tests/cases.hpp"
#include "tests/files.hpp"

namespace microswarm {
namespace {

TEST(Gather, RobotsAnywhereInARealVesselMaskComeTogether) {
  const std::filesystem::path mask = test::data_folder() / "vessels" / "CHASE_09L_mask_obs1.png";
  if (!std::filesystem::exists(mask)) GTEST_SKIP() << "no " << mask;
  constexpr double step = 4;
  Scenario s;
  s.map = guess_map_spec(mask, 6.0);
  s.robots.emplace().count = test::cases(48);
  s.robots->max_speed = 80;
  s.tick = step / s.robots->max_speed;
  s.time_limit = 100'000 * s.tick;
  s.goal = Vec2{234, 3217};  // a dead end
  s.goal_tolerance = 10 * step;
  AggregationParams params;
  params.scale = step;
  for (const Aggregation method : {Aggregation::divide_and_conquer, Aggregation::heuristic}) {
    if (test::sanitized && method == Aggregation::heuristic) break;  // steps in the same map
    params.method = method;
    s.navigator = params;
    const World world = build_world(load_scene(s, {}));
    EXPECT_TRUE(validate(s, world).empty());
    EXPECT_EQ(simulate(s, world).status, Status::solved);
  }
}

}  // namespace
}  // namespace microswarm
