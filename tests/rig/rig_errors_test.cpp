// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/rig_errors.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/session/open_on_rig.hpp"
#include "tests/files.hpp"

namespace microswarm::rig {
namespace {

RigExperiment opened_with(const std::vector<std::string>& rig_settings,
                          const std::vector<std::string>& settings = {}) {
  const std::filesystem::path scenarios =
      std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";
  return open_rig_experiment(scenarios / "papers/drrt/s_channel.yaml", {settings, ""},
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

TEST(RigErrors, AnArrivalThatIsOnlyBelievedIsKnown) {
  RigTrial trial;
  for (const Status status : {Status::solved, Status::fault, Status::time_limit})
    for (const bool arrived : {false, true}) {
      trial.result.status = status;
      trial.arrived = arrived;
      EXPECT_EQ(trial.is_believed(), status == Status::solved && !arrived);
    }
}

// Positions are compared with the truth, not with what the camera shows.
TEST(RigErrors, ADisplacedCameraIsSeenInThePositions) {
  const std::vector<std::string> unwatched{"safety.max_map_shift_px=0",
                                           "safety.min_follow_share=0"};
  const std::vector<std::string> brief{"time_limit_s=5"};
  std::vector<std::string> displaced = unwatched;
  displaced.emplace_back("camera.microscope.shift_px=[0, 4]");
  const RigTrial good = run_on_rig(opened_with(unwatched, brief), 0);
  const RigTrial bad = run_on_rig(opened_with(displaced, brief), 0);
  EXPECT_NEAR(bad.position_error, 4 * 2.5, good.position_error + 2);
  EXPECT_GT(bad.position_error, good.position_error + 2);
  EXPECT_FALSE(bad.arrived);
  EXPECT_GT(bad.goal_distance, 500);
  const RigErrorRow row = error_row(bad, 3, "s", rig_errors()[0]);
  EXPECT_EQ(row.trial, 3);
  EXPECT_FALSE(row.arrived);
  EXPECT_EQ(row.error, "none");
}

}  // namespace
}  // namespace microswarm::rig
