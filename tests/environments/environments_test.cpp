// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/environments/environment_batch.hpp"
#include "microswarm/environments/gathering/gathering_episode.hpp"
#include "microswarm/environments/navigation/navigation_episode.hpp"

namespace microswarm::environments {
namespace {

/// A ring of cells, 2 wide, with a bar across: `#` is a wall.
GatheringMaze ring() {
  constexpr int width = 14;
  constexpr int height = 10;
  std::vector<std::uint8_t> free(width * height, 0);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const bool inner = row >= 2 && row < 8 && column >= 2 && column < 12;
      free[static_cast<std::size_t>(row * width + column)] = !inner || row == 5;
    }
  return {free, width, height};
}

GatheringRules rules(ParticlePhysics physics) {
  GatheringRules rules;
  rules.physics = physics;
  rules.n_particles = 60;
  rules.goal_range = 2;
  rules.max_episode_steps = 30;
  return rules;
}

std::size_t action_at(std::size_t step, std::size_t environment) {
  return (step / 3 + 3 * environment) % 8;
}

using Batch = EnvironmentBatch<GatheringEpisode, std::uint8_t>;

TEST(GatheringMaze, CostsObeyTheLawOfShortestPaths) {
  const GatheringMaze maze = ring();
  for (const MazePlace goal : {MazePlace{0, 0}, MazePlace{5, 7}, MazePlace{9, 13}}) {
    const MazeCosts costs = maze.costs_to(maze.number(goal));
    double sum = 0;
    for (const std::uint32_t cell : maze.cells()) {
      std::uint32_t best = MazeCosts::unreached - 1;
      for (const MazePlace& move : GatheringMaze::moves) {
        const MazePlace at = maze.place(cell);
        const MazePlace next{at.row + move.row, at.column + move.column};
        if (maze.is_free(next)) best = std::min(best, costs.of[maze.number(next)]);
      }
      EXPECT_EQ(costs.of[cell], cell == costs.goal ? 0 : best + 1);
      EXPECT_LE(costs.of[cell], costs.max);
      sum += costs.of[cell];
    }
    EXPECT_DOUBLE_EQ(costs.mean, sum / static_cast<double>(maze.cells().size() - 1));
    EXPECT_GE(maze.episode_length_estimate(costs), 1);
  }
}

TEST(GatheringMaze, RefusesSidesAndGoalsThatAreNone) {
  const std::vector<std::uint8_t> free(4, 0);
  EXPECT_THROW(GatheringMaze(free, 2, 2), InputError);
  EXPECT_THROW(GatheringMaze({}, 0, 5), InputError);
  EXPECT_THROW(GatheringTask(ring(), {}, MazePlace{4, 4}), InputError);
  EXPECT_THROW(GatheringTask(ring(), {}, MazePlace{-1, 0}), InputError);
  EXPECT_THROW(GatheringTask(ring(), rules(ParticlePhysics::fuzzy), MazePlace{10, 0}), InputError);
}

class GatheringPhysics : public testing::TestWithParam<ParticlePhysics> {};

TEST_P(GatheringPhysics, ParticlesStayInFreeCellsAndKeepTheirNumber) {
  const GatheringTask task(ring(), rules(GetParam()), MazePlace{0, 0});
  std::vector<std::uint8_t> picture(task.picture_size());
  GatheringEpisode episode(task, 1, picture);
  for (std::size_t step = 0; step < 200; ++step) {
    episode.step(action_at(step, 0));
    const ParticleMotion& motion = episode.motion();
    std::uint32_t count = 0;
    std::vector<std::uint32_t> in(task.maze.size(), 0);
    for (std::size_t i = 0; i < motion.cells().size(); ++i) {
      EXPECT_TRUE(task.maze.is_free(motion.cells()[i]));
      count += motion.counts()[i];
      in[motion.cells()[i]] += motion.counts()[i];
    }
    EXPECT_EQ(count, 60u);
    if (GetParam() == ParticlePhysics::physical) {
      EXPECT_LE(*std::ranges::max_element(in), 3u);
    }
    const auto shown = std::ranges::count(picture, std::uint8_t{255});
    EXPECT_EQ(shown, std::ranges::count_if(in, [](std::uint32_t n) { return n > 0; }));
  }
}

TEST_P(GatheringPhysics, ThreadsChangeNothing) {
  GatheringRules random = rules(GetParam());
  random.particle_count = ParticleCount::random;
  random.observation = GatheringObservation::multichannel;
  const GatheringTask task(ring(), random, std::nullopt);
  constexpr std::size_t count = 40;
  std::vector<std::vector<double>> all;
  std::vector<std::vector<std::uint8_t>> pictures;
  for (const int threads : {1, 2, 5}) {
    Batch batch(task, count, task.picture_size(), 11, threads);
    std::vector<double>& told = all.emplace_back();
    std::vector<double> rewards(count);
    std::vector<std::uint8_t> ended(count), cut(count);
    for (std::size_t step = 0; step < 100; ++step) {
      batch.step([&](std::size_t i) { return action_at(step, i); }, rewards, ended, cut);
      told.insert(told.end(), rewards.begin(), rewards.end());
      told.insert(told.end(), ended.begin(), ended.end());
      told.insert(told.end(), cut.begin(), cut.end());
    }
    pictures.push_back(*batch.observations());
  }
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_EQ(all[i], all[0]);
    EXPECT_EQ(pictures[i], pictures[0]);
  }
}

TEST(EnvironmentBatch, NeedsAResetAfterAStop) {
  const GatheringTask task(ring(), rules(ParticlePhysics::algorithmic), MazePlace{0, 0});
  Batch batch(task, 3, task.picture_size(), 1, 1);
  std::vector<double> rewards(3);
  std::vector<std::uint8_t> ended(3), cut(3);
  const auto east = [](std::size_t) { return std::size_t{0}; };
  std::atomic<bool> stops = true;
  batch.step(east, rewards, ended, cut, {}, Stop(&stops));
  EXPECT_THROW(batch.step(east, rewards, ended, cut), InputError);
  batch.reset();
  batch.step(east, rewards, ended, cut);
}

TEST_P(GatheringPhysics, ACopyAndARestoredStateGoOnIdentically) {
  GatheringRules random = rules(GetParam());
  random.particle_count = ParticleCount::random;
  for (const std::optional<MazePlace> goal : {std::optional<MazePlace>(), {MazePlace{0, 0}}}) {
    const GatheringTask task(ring(), random, goal);
    std::vector<std::uint8_t> first(task.picture_size()), second = first, third = first;
    GatheringEpisode episode(task, 3, first);
    for (std::size_t step = 0; step < 100; ++step) {
      if (step % 40 == 39) episode.reset();
      episode.step(action_at(step, 1));
    }
    GatheringEpisode copy(episode, second);
    GatheringEpisode restored(task, 1, third);
    restored.restore(episode.state());
    for (std::size_t step = 0; step < 100; ++step) {
      ASSERT_EQ(first, second);
      ASSERT_EQ(first, third);
      const std::size_t action = action_at(step, 2);
      const double reward = episode.step(action).reward;
      ASSERT_EQ(copy.step(action).reward, reward);
      ASSERT_EQ(restored.step(action).reward, reward);
      if (step % 30 == 29) episode.reset(), copy.reset(), restored.reset();
    }
  }
}

TEST(EnvironmentBatch, BeginsTheNextEpisodeAsItsModeSays) {
  const GatheringTask task(ring(), rules(ParticlePhysics::algorithmic), MazePlace{0, 0});
  std::vector<double> rewards(2);
  std::vector<std::uint8_t> ended(2), cut(2);
  const auto step = [&](Batch& batch) {
    batch.step([](std::size_t i) { return i; }, rewards, ended, cut);
    return batch.made(1);
  };
  for (const Autoreset mode : {Autoreset::next_step, Autoreset::same_step, Autoreset::disabled}) {
    Batch batch(task, 2, task.picture_size(), 1, 1, mode);
    EnvironmentStep made;
    for (int i = 0; i < 30; ++i) made = step(batch);
    EXPECT_TRUE(cut[1]);
    EXPECT_FALSE(made.success);
    EXPECT_EQ(made.reason, "step_limit");
    EXPECT_EQ(batch.episode(1).steps(), mode == Autoreset::same_step ? 0 : 30);
    if (mode == Autoreset::same_step) {
      EXPECT_NE(std::ranges::count(batch.final_observation(1), 255), 0);
      EXPECT_FALSE(std::ranges::equal(batch.final_observation(1),
                                      std::span(*batch.observations()).last(batch.size())));
    }
    if (mode == Autoreset::disabled) {
      EXPECT_THROW(step(batch), InputError);
      const std::vector<std::optional<std::uint64_t>> seeds(2);
      batch.reset(seeds, std::vector<std::uint8_t>{1, 0});
      EXPECT_THROW(step(batch), InputError);
      batch.reset(seeds, std::vector<std::uint8_t>{0, 1});
      EXPECT_EQ(batch.episode(0).steps(), 0);
    }
    EXPECT_EQ(step(batch).reason, "");
    EXPECT_EQ(batch.episode(1).steps(), mode == Autoreset::next_step ? 0 : 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, GatheringPhysics,
                         testing::Values(ParticlePhysics::algorithmic, ParticlePhysics::fuzzy,
                                         ParticlePhysics::physical),
                         [](const auto& one) { return std::string(enum_name(one.param)); });

const std::filesystem::path scenarios = std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";

TEST(NavigationEpisode, ThreadsAndASecondResetChangeNothing) {
  NavigationRules rules;
  rules.random_start = rules.random_goal = true;
  const NavigationTask task(experiment::open_experiment(scenarios / "first_flight.yaml"), rules);
  constexpr std::size_t count = 20;
  std::vector<std::vector<float>> seen;
  for (const int threads : {1, 3}) {
    EnvironmentBatch<NavigationEpisode, float> batch(task, count, task.observation_size(), 3,
                                                     threads);
    for (int round = 0; round < 2; ++round) {
      batch.reset(3);
      std::vector<double> rewards(count);
      std::vector<std::uint8_t> ended(count), cut(count);
      for (int step = 0; step < 30; ++step)
        batch.step(
            [&](std::size_t i) {
              return NavigationAction{0.3 * static_cast<double>(i), task.max_speed()};
            },
            rewards, ended, cut);
      seen.push_back(*batch.observations());
    }
  }
  for (const auto& one : seen) EXPECT_EQ(one, seen[0]);
}

TEST(NavigationEpisode, EndsInTheGoal) {
  experiment::Experiment experiment =
      experiment::open_experiment(scenarios / "first_flight.yaml", {"obstacles=[]"});
  const NavigationTask task(std::move(experiment), {});
  std::vector<float> observation(task.observation_size());
  NavigationEpisode episode(task, 1, observation);
  EnvironmentStep step;
  for (int i = 0; i < 1000 && !step.terminated; ++i) {
    step = episode.step({heading_along({observation[0], observation[1]}), task.max_speed()});
    ASSERT_FALSE(step.truncated);
  }
  EXPECT_EQ(episode.status(), Status::solved);
  EXPECT_LE(distance(episode.pose().position, episode.goal()),
            task.scenario().goal_tolerance * (1 + 1e-9));
  EXPECT_EQ(episode.step({0, task.max_speed()}).reward, 0);
}

TEST(NavigationEpisode, ACopyGoesOnIdenticallyAndScaledNumbersAreSmall) {
  for (const bool scaled : {true, false}) {
    NavigationRules rules;
    rules.random_start = rules.random_goal = true;
    rules.scaled = scaled;
    const NavigationTask task(experiment::open_experiment(scenarios / "first_flight.yaml"), rules);
    std::vector<float> first(task.observation_size()), second = first;
    NavigationEpisode episode(task, 2, first);
    const auto go = [&](NavigationEpisode& one, int step) {
      return one.step({0.1 * step, task.max_speed()});
    };
    episode.reset();
    for (int step = 0; step < 20; ++step) go(episode, step);
    NavigationEpisode copy(episode, second);
    for (int step = 0; step < 200; ++step) {
      ASSERT_EQ(first, second);
      const EnvironmentStep made = go(episode, step);
      ASSERT_EQ(go(copy, step).reward, made.reward);
      if (made.has_ended()) episode.reset(), copy.reset();
      const float most = std::ranges::max(first, {}, [](float v) { return std::abs(v); });
      ASSERT_EQ(std::abs(most) <= 1, scaled);
    }
  }
}

TEST(NavigationTask, RefusesRobots) {
  EXPECT_THROW(
      NavigationTask(experiment::open_experiment(scenarios / "papers/gather/t_junction.yaml"), {}),
      InputError);
}

}  // namespace
}  // namespace microswarm::environments
