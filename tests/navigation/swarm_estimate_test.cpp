// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/swarm_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/rng.hpp"

namespace microswarm::navigation {
namespace {

constexpr double tick = 0.1;
constexpr double speed = 80;
const SwarmLimits round_swarm{.radius = 40, .max_speed = speed, .max_turn_rate = 3};

struct Errors {
  double frames = 0;     ///< root mean square of a coordinate of the frames [µm]
  double estimates = 0;  ///< of the estimates [µm]
  double expected = 0;   ///< of the estimates, as they tell [µm]
};

/// A swarm that turns now and then, seen with `noise` [µm], displaced by `motion` [µm] in each
/// tick.
Errors errors(double noise, double motion, std::uint64_t seed) {
  Rng rng(seed, Purpose::test);
  const auto displaced = [&](Vec2 p, double sigma) {
    return p + sigma * Vec2{rng.normal(), rng.normal()};
  };
  DelayCompensator commands(round_swarm);
  SwarmEstimate estimate(3);
  Pose2 pose{{500, 500}, 0};
  Errors sums;
  int n = 0;
  for (int k = 0; k < 400; ++k) {
    const double t = tick * k;
    const SwarmPose frame{{displaced(pose.position, noise), pose.heading}, 40};
    commands.at_effect({.now = t, .seen = t, .swarm = frame});
    const Vec2 estimated = estimate.update(frame, t, commands).pose.position;
    if (k >= 50) {
      ++n;
      sums.frames += squared_norm(frame.pose.position - pose.position);
      sums.estimates += squared_norm(estimated - pose.position);
      sums.expected += estimate.variance();
    }
    const Command command{0.7 * (k / 20), speed};
    commands.note(t, command);
    pose = unicycle_step(pose, command, round_swarm.max_turn_rate, tick);
    pose.position = displaced(pose.position, motion);
  }
  return {std::sqrt(sums.frames / (2 * n)), std::sqrt(sums.estimates / (2 * n)),
          std::sqrt(sums.expected / n)};
}

TEST(SwarmEstimate, WithoutNoiseItIsTheFrame) { EXPECT_EQ(errors(0, 0, 1).estimates, 0); }

// Kalman's gain for noise of 8 µm and 2 µm of motion leaves 3.8 µm; the estimated variances cost
// some.
TEST(SwarmEstimate, NoiseIsTakenOut) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Errors steady = errors(8, 0, seed);
    EXPECT_LT(steady.estimates, 0.45 * steady.frames);
    const Errors moved = errors(8, 2, seed);
    EXPECT_LT(moved.estimates, 0.6 * moved.frames);
    EXPECT_GT(moved.estimates, 3.7);
  }
}

TEST(SwarmEstimate, MotionThatNoCommandExplainsIsFollowed) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    EXPECT_LT(errors(0, 5, seed).estimates, 1.5);
    EXPECT_LT(errors(1, 5, seed).estimates, 1.6);
  }
}

TEST(SwarmEstimate, ItsVarianceCoversItsErrors) {
  for (const double noise : {0.0, 1.0, 4.0, 8.0})
    for (const double motion : {0.0, 1.0, 4.0}) {
      const Errors e = errors(noise, motion, 7);
      EXPECT_GE(e.expected, 0.95 * e.estimates) << noise << " " << motion;
      EXPECT_LE(e.expected, 1.3 * e.estimates + 1.3 * motion + 0.2 * noise + 1e-9)
          << noise << " " << motion;
    }
}

TEST(SwarmEstimate, ASwarmThatIsCarriedAwayIsFoundInSomeFrames) {
  Rng rng(3, Purpose::test);
  DelayCompensator commands(round_swarm);
  SwarmEstimate estimate(3);
  Vec2 estimated;
  for (int k = 0; k < 105; ++k) {
    const Vec2 at = k < 100 ? Vec2{500, 500} : Vec2{700, 500};
    const Vec2 seen = at + 4 * Vec2{rng.normal(), rng.normal()};
    estimated = estimate.update({{seen, 0}, 40}, tick * k, commands).pose.position;
  }
  EXPECT_LT(distance(estimated, Vec2{700, 500}), 12);
}

// The commanded path is a circle, so a flow is neither a speed nor a turn that was not commanded.
TEST(SwarmEstimate, AFlowIsLearntAndTakenOut) {
  const Vec2 flow{15, -8};
  for (const double noise : {0.0, 2.0, 6.0}) {
    Rng rng(5, Purpose::test);
    DelayCompensator commands(round_swarm);
    SwarmEstimate estimate(3);
    Pose2 pose{{500, 500}, 0};
    double squares = 0, flows = 0;
    const int first = 60, last = 260;
    for (int k = 0; k < last; ++k) {
      const double t = tick * k;
      const Vec2 seen = pose.position + noise * Vec2{rng.normal(), rng.normal()};
      const SwarmPose frame{{seen, pose.heading}, 40};
      commands.at_effect({.now = t, .seen = t, .swarm = frame});
      const Vec2 estimated = estimate.update(frame, t, commands).pose.position;
      if (k >= first) {
        squares += squared_norm(estimated - pose.position);
        flows += squared_norm(estimate.response().flow - flow);
      }
      const Command command{0.1 * k, speed};
      commands.note(t, command);
      pose = unicycle_step(pose, command, round_swarm.max_turn_rate, tick);
      pose.position += tick * flow;
    }
    const double off = std::sqrt(squares / (2 * (last - first)));
    EXPECT_LT(off, 0.75 * noise + 1e-6) << noise;
    EXPECT_LT(std::sqrt(flows / (last - first)), 1.5 * noise + 1e-6) << noise;
    // A frame that misses it: the flow carries on.
    const double t = tick * last;
    const Vec2 before = pose.position;
    EXPECT_LT(distance(estimate.bridge(t, commands).pose.position, before), 3 * noise + 1e-6);
  }
}

TEST(SwarmEstimate, WithoutAFlowNoneIsTaken) {
  for (const std::uint64_t seed : {1, 2, 3}) EXPECT_LT(errors(8, 0, seed).estimates, 3.6);
  DelayCompensator commands(round_swarm);
  SwarmEstimate estimate(3);
  for (int k = 0; k < 5; ++k) estimate.update({{{500, 500}, 0}, 40}, tick * k, commands);
  EXPECT_EQ(estimate.response(), SwarmResponse{});
}

TEST(SwarmEstimate, FramesThatMissItAreBridgedByCommands) {
  DelayCompensator commands(round_swarm);
  SwarmEstimate estimate(3);
  estimate.update({{{500, 500}, 0}, 40}, 0, commands);
  commands.note(0, {0, speed});
  EXPECT_NEAR(estimate.bridge(0.1, commands).pose.position.x, 508, 1e-9);
  EXPECT_NEAR(estimate.bridge(0.2, commands).pose.position.x, 516, 1e-9);
  EXPECT_EQ(estimate.shown(), 0);
  EXPECT_NEAR(estimate.update({{{524, 500}, 0}, 40}, 0.3, commands).pose.position.x, 524, 1e-9);
  EXPECT_NEAR(estimate.variance(), 0, 1e-9);
  EXPECT_EQ(estimate.shown(), 0.3);
}

TEST(SwarmEstimate, AFrameThatIsSeenTwiceCountsOnce) {
  DelayCompensator commands(round_swarm);
  SwarmEstimate estimate(3);
  estimate.update({{{500, 500}, 0}, 40}, 1, commands);
  EXPECT_EQ(estimate.update({{{550, 500}, 0}, 40}, 1, commands).pose.position, Vec2(500, 500));
  EXPECT_EQ(estimate.variance(), 0);
}

}  // namespace
}  // namespace microswarm::navigation
