// SPDX-License-Identifier: Apache-2.0
#include "microswarm/learning/follower_training.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>

#include "microswarm/learning/follower_comparison.hpp"
#include "microswarm/navigation/following/follower_model.hpp"

namespace microswarm::learning {
namespace {

FollowerTrainingParams small() {
  FollowerTrainingParams p;
  p.runs = 10;
  p.rounds = 1;
  p.hidden = 8;
  p.iterations = p.last_iterations = 40;
  return p;
}

double mean_off(const FollowerOutcome& outcome) {
  double sum = 0;
  for (const FollowedPath& p : outcome.paths) sum += p.rms_off;
  return sum / static_cast<double>(outcome.paths.size());
}

TEST(FollowerTask, SameNumberSameTask) {
  const FollowerTask a = follower_task({}, 1, 7), b = follower_task({}, 1, 7);
  EXPECT_EQ(a.path, b.path);
  EXPECT_EQ(experiment::scenario_text(a.scenario), experiment::scenario_text(b.scenario));
  EXPECT_NE(a.path, follower_task({}, 1, 8).path);
}

TEST(FollowerTraining, SameSeedSameBytesOnAnyThreads) {
  const TrainedFollower one = train_follower(small(), {.jobs = 1, .progress = {}});
  const TrainedFollower two = train_follower(small(), {.jobs = 2, .progress = {}});
  ASSERT_TRUE(one.finished);
  EXPECT_EQ(navigation::follower_model_text(one.model), navigation::follower_model_text(two.model));
  EXPECT_EQ(one.held_out_error, two.held_out_error);
}

TEST(FollowerTraining, LearnsInAShortTime) {
  FollowerTrainingParams none = small();
  none.iterations = none.last_iterations = 1;
  const TrainedFollower before = train_follower(none), after = train_follower(small());
  EXPECT_LT(after.held_out_error, 0.6 * before.held_out_error);
}

TEST(FollowerTraining, RoundsOfTheStudentAddData) {
  FollowerTrainingParams p = small();
  p.rounds = 0;
  const std::size_t of_expert = train_follower(p).demonstrations;
  EXPECT_GT(of_expert, 10U * 50U);
  EXPECT_GT(train_follower(small()).demonstrations, of_expert + 10U * 50U);
}

TEST(FollowerTraining, TheStudentDrivesAndTheExpertSaysWhatItWouldHaveDone) {
  const FollowerTask task = follower_task({}, 1, 3);
  const auto student =
      std::make_shared<const navigation::FollowerModel>(navigation::default_follower_model());
  const auto expert_drove = demonstrate(task, nullptr), student_drove = demonstrate(task, student);
  ASSERT_FALSE(expert_drove.empty());
  ASSERT_FALSE(student_drove.empty());
  EXPECT_EQ(expert_drove[0].features, student_drove[0].features);
  EXPECT_EQ(expert_drove[0].answer, student_drove[0].answer);
  EXPECT_NE(expert_drove[20].features, student_drove[20].features);
}

TEST(FollowerTraining, EndsWhenTold) {
  std::atomic<bool> told = false;
  double last = 0;
  const TrainingOptions options{.jobs = 1, .progress = [&](double share, const std::string&) {
                                  EXPECT_GE(share, last);
                                  last = share;
                                  told = share > 0.3;
                                }};
  EXPECT_FALSE(train_follower(small(), options, Stop(&told)).finished);
}

TEST(FollowerComparison, TheBuiltInModelArrivesAndIsNearerThanPurePursuit) {
  const ComparisonOptions options{.tasks = 8, .params = {}};
  const auto outcomes = compare_followers(options);
  ASSERT_EQ(outcomes.size(), 4U);
  for (const FollowerOutcome& o : outcomes)
    for (const FollowedPath& p : o.paths) EXPECT_TRUE(p.arrived) << o.name;
  EXPECT_LT(mean_off(outcomes[2]), mean_off(outcomes[0]));
  EXPECT_LT(mean_off(outcomes[3]), mean_off(outcomes[2]));  // the expert knows more
}

}  // namespace
}  // namespace microswarm::learning
