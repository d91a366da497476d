// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/following/path_navigator.hpp"
#include "microswarm/swarm/body/ribbon.hpp"
#include "tests/messages.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

const std::vector<Vec2> long_corner{{0, 0}, {300, 0}, {300, 300}};

std::string with_line(const std::string& begin, const std::string& line) {
  std::string text = follower_model_text(default_follower_model());
  const auto at = text.find(begin);
  text.replace(at, text.find('\n', at) - at, line);
  return text;
}

std::string complaint(const std::string& text) {
  try {
    parse_follower_model(text, "m.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FollowerModel, IsReadBackToTheSameBits) {
  FollowerModel model = default_follower_model();
  model.seed = std::numeric_limits<std::uint64_t>::max();
  model.network.weights[0] = 0.1 + 0.2;
  const std::string text = follower_model_text(model);
  const FollowerModel again = parse_follower_model(text, "m.yaml");
  EXPECT_EQ(again.network.weights, model.network.weights);
  EXPECT_EQ(again.seed, model.seed);
  EXPECT_EQ(follower_model_text(again), text);
}

TEST(FollowerModel, DamagedOnesAreRefusedInOneLine) {
  const std::string whole = follower_model_text(default_follower_model());
  EXPECT_EQ(complaint(whole), "");
  EXPECT_EQ(complaint(""), "m.yaml: 'version: ' must stand here");
  EXPECT_EQ(complaint("root:x:0:0:root:/root\n").find("root"), std::string::npos);
  EXPECT_TRUE(test::is_one_line_naming(complaint(with_line("version", "version: 2")), "m.yaml:2",
                                       {"version", "2", "1"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(with_line("seed", "seed: -1")), "m.yaml:3",
                                       {"seed", "-1"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(with_line("layers", "layers: [7, 2]")), "m.yaml:5",
                                       {"7", "18"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(with_line("layers", "layers: [18, 3]")),
                                       "m.yaml:5", {"3", "2"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(with_line("layers", "layers: [18, 65, 2]")),
                                       "m.yaml:5", {"layer", "65", "1..64"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(with_line("layers", "layers: 18")), "m.yaml:5",
                                       {"layers: "}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(with_line("lowest", "lowest: [1, nan]")),
                                       "m.yaml:6", {"nan", "1000000"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(with_line("lowest", "lowest: [1, 2]")), "m.yaml:6",
                                       {"2", "numbers", "18"}));
  EXPECT_EQ(complaint(with_line("highest", "")).substr(0, 9), "m.yaml:9:");
  EXPECT_EQ(complaint(whole + "more\n").substr(0, 7), "m.yaml:");
  for (std::size_t cut = 0; cut + 2 < whole.size(); cut += 97)
    EXPECT_NE(complaint(whole.substr(0, cut)), "") << cut;
}

SwarmLimits swarm_of(double turn_rate) {
  return {.radius = 20, .max_speed = 60, .max_turn_rate = turn_rate, .response_lag = 0.1};
}

TEST(PathFollower, HandsOverWhereItWasNotTrained) {
  const FollowerParams learned{.kind = FollowerKind::learned};
  const Pose2 pose{{50, 5}, 0.1};
  PathPosition position;
  EXPECT_FALSE(
      PathFollower(learned, swarm_of(3)).command(long_corner, position, pose, 20, 60).handed_over);
  // Slower to turn than any swarm of the training.
  position = {};
  const auto answer =
      PathFollower(learned, swarm_of(0.1)).command(long_corner, position, pose, 20, 60);
  EXPECT_TRUE(answer.handed_over);
  PathPosition of_plain;
  const Command plain = pursue(long_corner, of_plain, pose, 20, 60);
  EXPECT_EQ(answer.command.heading, plain.heading);
  EXPECT_EQ(answer.command.speed, plain.speed);
}

TEST(PathFollower, CommandsDoNotDependOnWhereTheWorldLies) {
  const PathFollower follower({.kind = FollowerKind::learned}, swarm_of(3));
  const auto off_bearing = [&](double turn, Vec2 shift) {
    const auto moved = [&](Vec2 p) {
      return shift + Vec2{p.x * std::cos(turn) - p.y * std::sin(turn),
                          p.x * std::sin(turn) + p.y * std::cos(turn)};
    };
    const std::vector<Vec2> path{moved(long_corner[0]), moved(long_corner[1]),
                                 moved(long_corner[2])};
    PathPosition position;
    return wrap(
        follower.command(path, position, {moved({270, 4}), 0.2 + turn}, 20, 60).command.heading -
        turn);
  };
  EXPECT_NEAR(off_bearing(0, {}), off_bearing(2, {500, -900}), 1e-9);
}

/// Drives a ribbon in a flow along the corner; the state of the navigator in its last step.
std::string drive(const FollowerParams& follower, const RibbonParams& params, double& rms) {
  const Map map({{-200, -200}, {500, 500}}, std::vector<Polygon>{});
  const Snapshot world(std::make_shared<const Map>(map));
  PathNavigator navigator({.path = {long_corner[0], long_corner[1]}, .follower = follower},
                          body_task(swarm_of(params.max_turn_rate), long_corner[2], 10),
                          Rng(1, Purpose::planner));
  Ribbon ribbon(params, {long_corner[0], 0});
  Rng rng(1, Purpose::test);
  PathPosition position;
  double sum = 0;
  int ticks = 0;
  for (; ticks < 300 && navigator.view().state != NavigatorState::arrived; ++ticks) {
    const Pose2 pose = ribbon.pose();
    const Observation seen{.now = 0.1 * ticks,
                           .seen = 0.1 * ticks,
                           .swarm = SwarmPose{pose, 20},
                           .robots = {},
                           .world = borrowed(world)};
    position = nearest_position(long_corner, pose.position, position);
    sum += squared_norm(pose.position - point_ahead(long_corner, position, 0));
    ribbon.step(navigator.step(seen, {}), 0.1, rng);
  }
  rms = std::sqrt(sum / ticks);
  return std::string(enum_name(navigator.view().state));
}

TEST(PathNavigator, TheLearnedFollowerIsNearerToThePathInAFlow) {
  const RibbonParams ribbon{.radius = 20, .max_speed = 60, .drift = {6, 6}, .speed_factor = 0.9};
  double plain = 0, against_flow = 0, learned = 0;
  EXPECT_EQ(drive({}, ribbon, plain), "arrived");
  EXPECT_EQ(drive({.correct_flow = true}, ribbon, against_flow), "arrived");
  EXPECT_EQ(drive({.kind = FollowerKind::learned}, ribbon, learned), "arrived");
  EXPECT_LT(against_flow, plain);
  EXPECT_LT(learned, plain);
}

TEST(PathNavigator, SaysThatItHandsOver) {
  const Map map({{-200, -200}, {500, 500}}, std::vector<Polygon>{});
  const Snapshot world(std::make_shared<const Map>(map));
  for (const double turn_rate : {3.0, 0.1}) {
    PathNavigator navigator(
        {.path = {long_corner[0], long_corner[1]}, .follower = {.kind = FollowerKind::learned}},
        body_task(swarm_of(turn_rate), long_corner[2], 10), Rng(1, Purpose::planner));
    navigator.step(
        {.now = 0, .seen = 0, .swarm = SwarmPose{{{0, 0}, 0}, 20}, .world = borrowed(world)}, {});
    EXPECT_EQ(navigator.view().state,
              turn_rate == 3.0 ? NavigatorState::follow : NavigatorState::fallback);
  }
}

TEST(FlowEstimate, FindsTheFlowInNoise) {
  DelayCompensator forecast(swarm_of(3));
  FlowEstimate estimate;
  Rng rng(3, Purpose::test);
  Ribbon ribbon({.max_speed = 60, .drift = {5, -3}}, {});
  Vec2 mean{};
  for (int k = 0; k < 300; ++k) {
    const Pose2 pose = ribbon.pose();
    const double x = rng.normal();
    const Observation seen{
        .now = 0.1 * k,
        .seen = 0.1 * k,
        .swarm = SwarmPose{{pose.position + 2.0 * Vec2{x, rng.normal()}, pose.heading}, 20}};
    estimate.update(seen, forecast);
    forecast.at_effect(seen);
    const Command command{0.02 * k, 60};
    forecast.note(seen.now, command);
    ribbon.step(command, 0.1, rng);
    if (k >= 100) mean += (1.0 / 200) * estimate.flow();
    if (k >= 100) {
      EXPECT_LT(distance(estimate.flow(), Vec2{5, -3}), 5);
    }
  }
  EXPECT_LT(distance(mean, Vec2{5, -3}), 0.5);
}

}  // namespace
}  // namespace microswarm::navigation
