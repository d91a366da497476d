// SPDX-License-Identifier: Apache-2.0
// The dynamic worlds of Fig 5 [drrt]: safe and arriving, seed after seed.
#include <gtest/gtest.h>

#include <filesystem>

#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/trials.hpp"

namespace microswarm {
namespace {

class DynamicWorld : public testing::TestWithParam<const char*> {};

TEST_P(DynamicWorld, ArrivesAndKeepsItsMargin) {
  const auto folder = std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios/papers/drrt";
  const experiment::Scene scene =
      experiment::load_scene(experiment::read_scenario(folder / GetParam()), folder);
  const World world = experiment::build_world(scene);
  for (const experiment::TrialResult& t :
       experiment::run_trials(scene.scenario, world, {.trials = 12, .jobs = 2})) {
    EXPECT_EQ(t.result.status, Status::solved);
    EXPECT_GE(t.result.metrics.obstacles.clearance, 90);
    EXPECT_EQ(t.result.metrics.contacts, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Fig5, DynamicWorld,
                         testing::Values("deforming_channel.yaml", "moving_obstacles.yaml"),
                         [](const auto& scenario) {
                           const std::string name = scenario.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace microswarm
