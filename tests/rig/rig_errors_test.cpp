// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/rig_errors.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/session/open_on_rig.hpp"
#include "tests/files.hpp"

namespace microswarm::rig {
namespace {

RigExperiment opened_with(std::vector<std::string> rig_settings) {
  const std::filesystem::path scenarios =
      std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";
  rig_settings.emplace_back("camera.microscope.um_per_px=4");
  return open_rig_experiment(scenarios / "papers/drrt/s_channel.yaml", {},
                             scenarios / "rigs/ribbon.yaml", {rig_settings, ""});
}

TEST(RigErrors, EveryErrorIsRefusedOrEndsTheRunOrItArrivesInTruth) {
  int refused = 0, faults = 0, arrived = 0;
  for (const RigError& error : rig_errors()) {
    const RigExperiment on = opened_with(error.rig_settings);
    try {
      require_simulated_map(on);
    } catch (const InputError&) {
      ++refused;
      continue;
    }
    const RigTrial trial = run_on_rig(on, 0);
    EXPECT_FALSE(trial.is_believed()) << error.name;
    EXPECT_EQ(trial.result.metrics.contacts, 0) << error.name;
    EXPECT_EQ(trial.fault.empty(), trial.arrived) << error.name << trial.fault;
    faults += !trial.fault.empty();
    arrived += trial.arrived;
  }
  EXPECT_GE(refused, 4);
  EXPECT_GE(faults, 3);
  EXPECT_GE(arrived, 5);
}

// Without the comparison of map and picture the run believes to arrive.
TEST(RigErrors, AnArrivalThatIsOnlyBelievedIsKnown) {
  const RigExperiment on =
      opened_with({"safety.max_map_shift_px=0", "camera.microscope.shift_px=[0, 25]",
                   "camera.microscope.moved_after_s=20"});
  const RigTrial trial = run_on_rig(on, 0);
  ASSERT_EQ(trial.result.status, Status::solved) << trial.fault;
  EXPECT_TRUE(trial.is_believed());
  EXPECT_GT(trial.position_error, 80);
  EXPECT_GT(trial.goal_distance, on.scenario().goal_tolerance);
  const RigErrorRow row = error_row(trial, 3, "s", rig_errors()[0]);
  EXPECT_EQ(row.trial, 3);
  EXPECT_FALSE(row.arrived);
  EXPECT_EQ(row.error, "none");
}

}  // namespace
}  // namespace microswarm::rig
