// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/rig_comparison.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "microswarm/experiment/session/session.hpp"
#include "tests/files.hpp"

namespace microswarm::rig {
namespace {

class RigComparison : public testing::Test {
 protected:
  RigComparison()
      : on_(open_rig_experiment(scenarios_ / "papers/drrt/s_channel.yaml", {},
                                scenarios_ / "rigs/ribbon.yaml",
                                {"camera.type=simulated", "camera.microscope.um_per_px=6"})) {}

  const std::filesystem::path scenarios_ =
      std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";
  RigExperiment on_;
};

TEST_F(RigComparison, ItsTrialsAreThoseOfTheTwoSimulationsAtAnyNumberOfThreads) {
  std::vector<double> shares;
  const auto one = compare_with_rig(on_, 2, 1, [&](double share) { shares.push_back(share); });
  const auto two = compare_with_rig(on_, 2, 2, {});
  EXPECT_EQ(shares, (std::vector<double>{0.5, 1}));
  ASSERT_EQ(one.size(), 2u);
  ASSERT_EQ(two.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    const ComparedTrial& both = one[static_cast<std::size_t>(k)];
    EXPECT_EQ(both.trial, k);
    const experiment::RunResult plain =
        simulate(on_.scenario(), on_.experiment.world, {.trial = static_cast<std::uint32_t>(k)});
    EXPECT_EQ(both.kinematic.metrics.time, plain.metrics.time);
    EXPECT_EQ(both.rig.metrics.time, two[static_cast<std::size_t>(k)].rig.metrics.time);
    EXPECT_NE(both.rig.metrics.time, both.kinematic.metrics.time);
  }
}

TEST_F(RigComparison, AStoppedTrialIsNotCounted) {
  const std::atomic<bool> stopped{true};
  EXPECT_TRUE(compare_with_rig(on_, 3, 1, {}, Stop(&stopped)).empty());
}

TEST(RunSummary, SaysWhetherAllTrialsAreTheSameRun) {
  std::vector<ComparedTrial> trials(3);
  EXPECT_TRUE(summarise(trials, &ComparedTrial::rig).are_same);
  trials[2].rig.metrics.length = 1e-9;
  EXPECT_FALSE(summarise(trials, &ComparedTrial::rig).are_same);
  EXPECT_TRUE(summarise(trials, &ComparedTrial::kinematic).are_same);
  trials[1].kinematic.status = Status::solved;
  EXPECT_FALSE(summarise(trials, &ComparedTrial::kinematic).are_same);
  trials.resize(1);
  EXPECT_FALSE(summarise(trials, &ComparedTrial::rig).are_same);
}

TEST(RunSummary, CountsArrivalsAndTakesTheMedianOfTheirTimes) {
  std::vector<ComparedTrial> trials(4);
  for (int k = 0; k < 4; ++k) {
    trials[k].trial = k;
    trials[k].kinematic.metrics.time = 10 + k;
    trials[k].kinematic.status = k == 3 ? Status::time_limit : Status::solved;
    trials[k].rig.metrics.contacts = 1;
  }
  const RunSummary kinematic = summarise(trials, &ComparedTrial::kinematic);
  EXPECT_EQ(kinematic.arrived, 3);
  EXPECT_EQ(kinematic.time, 11);
  const RunSummary rig = summarise(trials, &ComparedTrial::rig);
  EXPECT_EQ(rig.arrived, 0);
  EXPECT_EQ(rig.contacts, 4);
  EXPECT_TRUE(std::isnan(rig.time));
  const auto rows = comparison_rows(trials, "two", "a=1");
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_EQ(rows[3].trial, 1);
  EXPECT_EQ(rows[2].plant, "kinematic");
  EXPECT_EQ(rows[3].plant, "rig");
  EXPECT_EQ(rows[2].time, 11);
}

}  // namespace
}  // namespace microswarm::rig
