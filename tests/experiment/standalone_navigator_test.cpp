// SPDX-License-Identifier: Apache-2.0
// A navigator in a loop of the caller's own beside the same one in ours.
#include "microswarm/experiment/session/standalone_navigator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/plant/make_plant.hpp"
#include "microswarm/experiment/plant/plant.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "tests/experiment/scenes.hpp"

namespace microswarm::experiment {
namespace {

const std::filesystem::path shipped = std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";

ExternalObservation to_observation(const Observation& seen) {
  ExternalObservation given{.now = seen.now, .seen = seen.seen, .unseen = seen.unseen};
  const auto bodies = seen.world->moving().bodies();
  given.obstacles.assign(bodies.begin(), bodies.end());
  given.are_numbered = true;
  given.robots.assign(seen.robots.begin(), seen.robots.end());
  if (seen.robots.empty()) given.swarm = seen.swarm;
  return given;
}

class InBothLoops : public testing::TestWithParam<const char*> {};

TEST_P(InBothLoops, TheCommandsAreTheSame) {
  const std::vector<std::string> settings{"time_limit_s=30"};
  const auto file = shipped / GetParam();
  Session session(open_experiment(file, {settings, ""}));
  session.finish();
  const std::vector<Frame>& frames = session.record().frames;

  Experiment experiment = open_experiment(file, {settings, ""});
  const auto plant = make_kinematic_plant(experiment.scenario(), experiment.world);
  StandaloneNavigator navigator(std::move(experiment));
  ASSERT_GT(frames.size(), 10u);
  for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
    const Command command = navigator.step(to_observation(plant->observe()));
    ASSERT_EQ(command.heading, frames[k].command.heading) << k;
    ASSERT_EQ(command.speed, frames[k].command.speed) << k;
    ASSERT_EQ(navigator.view().state, frames[k].state) << k;
    plant->apply(command, navigator.scenario().tick);
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, InBothLoops,
                         testing::Values("first_flight.yaml", "oncoming.yaml",
                                         "papers/drrt/moving_obstacles.yaml",
                                         "papers/radar/twelve.yaml",
                                         "papers/gather/t_junction.yaml",
                                         "papers/global/two_robots.yaml"));

StandaloneNavigator small_navigator() {
  return StandaloneNavigator(open_experiment(small_flight(), {}));
}

TEST(StandaloneNavigator, MatchesObstaclesWithoutNumbers) {
  StandaloneNavigator plain = small_navigator(), numbered = small_navigator();
  ExternalObservation given{.swarm = SwarmPose{{{100, 100}, 0}, 20}};
  for (int k = 0; k < 20; ++k) {
    given.now = given.seen = 0.1 * k;
    given.swarm->pose.position.x += 2;
    const double x = 60 + 4.0 * k;
    given.obstacles = {{Disc{{x, 260}, 20}, 0}, {Disc{{x + 130, 40}, 15}, 1}};
    given.are_numbered = true;
    const Command a = numbered.step(given);
    for (Body& body : given.obstacles) body.obstacle = 0;
    if (k % 2 == 1) std::swap(given.obstacles[0], given.obstacles[1]);
    given.are_numbered = false;
    const Command b = plain.step(given);
    EXPECT_NEAR(a.heading, b.heading, 1e-9) << k;
    EXPECT_NEAR(a.speed, b.speed, 1e-9) << k;
  }
}

TEST(StandaloneNavigator, BadInputIsRefusedAndChangesNothing) {
  StandaloneNavigator navigator = small_navigator(), other = small_navigator();
  ExternalObservation good{.now = 1, .seen = 0.9, .swarm = SwarmPose{{{100, 100}, 0}, 20}};
  const double nan = std::nan("");
  const auto refuses = [&](auto&& spoil, const char* text) {
    ExternalObservation bad = good;
    bad.now = 2;
    spoil(bad);
    try {
      navigator.step(bad);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  navigator.step(good), other.step(good);
  refuses([&](ExternalObservation& s) { s.now = nan; }, "now_s is nan");
  refuses([&](ExternalObservation& s) { s.now = 0.5, s.seen = 0; },
          "before that of the step before");
  refuses([&](ExternalObservation& s) { s.seen = 3; }, "seen_s is 3");
  refuses([&](ExternalObservation& s) { s.swarm->pose.position.y = nan; },
          "place of the swarm is nan");
  refuses([&](ExternalObservation& s) { s.swarm->pose.heading = infinity; },
          "heading of the swarm is inf");
  refuses([&](ExternalObservation& s) { s.swarm->radius = -1; }, "radius of the swarm is -1");
  refuses(
      [&](ExternalObservation& s) {
        s.obstacles = {{Disc{{1, 2}, 0}}};
      },
      "radius of an obstacle is 0");
  refuses(
      [&](ExternalObservation& s) {
        s.obstacles = {{Disc{{1e9, 2}, 5}}};
      },
      "place of an obstacle is 1000000000");
  refuses(
      [&](ExternalObservation& s) {
        s.obstacles = {{Polygon{{{0, 0}, {1, 0}}, {}}}};
      },
      "fewer than 3");
  refuses(
      [&](ExternalObservation& s) {
        s.obstacles.assign(5'001, {Disc{{1, 2}, 3}});
      },
      "at most 5000");
  refuses(
      [&](ExternalObservation& s) {
        s.obstacles.assign(2, {Polygon{std::vector<Vec2>(60'000, Vec2{1, 2}), {}}});
      },
      "120000 points, at most 100000");
  refuses([&](ExternalObservation& s) { s.robots = {{1, 2}}; }, "has no robots");
  good.now = good.seen = 1.1;
  const Command command = navigator.step(good), same = other.step(good);
  EXPECT_EQ(command.heading, same.heading);
  EXPECT_EQ(command.speed, same.speed);
}

TEST(StandaloneNavigator, APreparationThatFailsChangesNothing) {
  StandaloneNavigator navigator(open_experiment(shipped / "papers/gather/t_junction.yaml",
                                                {"navigator.tree.max_iterations=5"}));
  ExternalObservation given{.now = 2, .seen = 2};
  given.robots.assign(static_cast<std::size_t>(navigator.scenario().robots->count), {50, 5});
  EXPECT_THROW(navigator.step(given), InputError);
  given.now = given.seen = 1;  // no step was made at 2
  try {
    navigator.step(given);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the tree has"), std::string::npos) << error.what();
  }
  given.swarm = SwarmPose{{{50, 5}, 0}, 1};
  EXPECT_THROW(navigator.step(given), InputError);
}

TEST(StandaloneNavigator, WithoutASwarmItHolds) {
  StandaloneNavigator navigator = small_navigator();
  EXPECT_EQ(navigator.step({.now = 1, .seen = 1}).speed, 0);
  EXPECT_EQ(navigator.view().state, NavigatorState::blind);
}

TEST(StandaloneNavigator, ScenariosAreReadFromText) {
  const std::string text = scenario_text(small_flight());
  const Experiment experiment = open_experiment_text(text, "chip", {}, {"seed=9"});
  EXPECT_EQ(experiment.scenario().seed, 9u);
  try {
    open_experiment_text("gaol_um: [1, 2]", "chip", {});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 38), "chip:1:1: unknown key 'gaol_um', did y");
  }
  EXPECT_THROW(open_experiment_text(std::string(20 << 20, ' '), "chip", {}), InputError);
}

}  // namespace
}  // namespace microswarm::experiment
