// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/trials.hpp"

#include <gtest/gtest.h>

#include "tests/experiment/scenes.hpp"
#include "tests/messages.hpp"

namespace microswarm::experiment {
namespace {

std::vector<std::string> hashes_of(const Scenario& scenario, const TrialOptions& options) {
  std::vector<std::string> hashes;
  for (const TrialResult& trial : run_trials(scenario, world_of(scenario), options)) {
    EXPECT_TRUE(trial.ran);
    hashes.push_back(trial.hash);
  }
  return hashes;
}

TEST(Trials, TwoThreadsGiveTheBitsOfOne) {
  const Scenario scenario = small_flight();
  const auto one = hashes_of(scenario, {.trials = 6, .jobs = 1});
  EXPECT_EQ(one, hashes_of(scenario, {.trials = 6, .jobs = 2}));
  EXPECT_EQ(one[2], record_of(scenario, 2).hash());
  EXPECT_NE(one[0], one[1]);
}

TEST(Trials, TrialsThatAreOneRunAreNoted) {
  EXPECT_EQ(same_run_note({}), "");
  const std::vector<std::string> one{"a"}, same{"a", "a", "a"}, last_differs{"a", "a", "b"};
  EXPECT_EQ(same_run_note(one), "");
  EXPECT_EQ(same_run_note(last_differs), "");
  EXPECT_TRUE(
      test::is_one_line_naming(same_run_note(same), "", {"all 3 trials", "same run", "random"}));
}

TEST(Trials, VaryChangesEachTrialByItself) {
  Scenario scenario = open_room();
  TrialOptions options{.trials = 4, .jobs = 2};
  options.vary = [](Scenario& s, std::uint32_t trial) {
    s.start->position.y = 300 + 100.0 * trial;
  };
  const auto trials = run_trials(scenario, world_of(scenario), options);
  for (std::uint32_t i = 0; i < 4; ++i) {
    scenario.start->position.y = 300 + 100.0 * i;
    EXPECT_EQ(trials[i].hash, record_of(scenario, i).hash());
  }
}

TEST(Trials, ProgressComesOnceATrialAndStopIsHeard) {
  const Scenario scenario = open_room();
  std::vector<int> heard;
  TrialOptions options{.trials = 5, .jobs = 2};
  options.progress = [&](int done, int) { heard.push_back(done); };
  run_trials(scenario, world_of(scenario), options);
  EXPECT_EQ(heard, (std::vector<int>{1, 2, 3, 4, 5}));

  const std::atomic<bool> flag{true};
  for (const TrialResult& trial : run_trials(scenario, world_of(scenario), options, Stop(&flag)))
    EXPECT_FALSE(trial.ran);
}

}  // namespace
}  // namespace microswarm::experiment
