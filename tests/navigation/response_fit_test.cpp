// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/response_fit.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/rng.hpp"

namespace microswarm::navigation {
namespace {

constexpr double between_frames = 0.1;
constexpr double full_speed = 80;

/// What is fitted to 10 s of a swarm with this response, seen with `noise` [µm]. Commands turn at
/// `turn` [rad/s], and take effect `late` [s] after they are thought to.
SwarmResponse fitted(const SwarmResponse& real, double noise, double turn, double late = 0) {
  Rng rng(4, Purpose::test);
  ResponseFit fit(3);
  Vec2 position{500, 500}, commanded;
  for (int k = 0; k < 100; ++k) {
    const double t = between_frames * k;
    fit.add(t, position + noise * Vec2{rng.normal(), rng.normal()}, commanded);
    commanded += between_frames * full_speed * unit_vector(turn * t);
    position += between_frames *
                (real.speed_factor * full_speed * unit_vector(turn * (t - late)) + real.flow);
  }
  return fit.response();
}

// The prior holds a fifth of the deviation back.
TEST(ResponseFit, TellsASpeedFactorFromAFlowWhereTheCourseTurns) {
  const SwarmResponse real{0.88, {8, -11}};
  for (const double noise : {0.0, 1.0, 3.0}) {
    const SwarmResponse found = fitted(real, noise, 1);
    EXPECT_NEAR(found.speed_factor, 0.88, 0.025 + 0.01 * noise) << noise;
    EXPECT_LT(norm(found.flow - real.flow), 0.7 + noise) << noise;
  }
}

TEST(ResponseFit, OnAStraightCourseItMovesTheSame) {
  const SwarmResponse real{0.88, {8, -11}};
  const SwarmResponse found = fitted(real, 0, 0);
  const Vec2 commanded{full_speed, 0};
  EXPECT_LT(distance(real.moved({}, commanded, 1), found.moved({}, commanded, 1)), 1e-6);
}

// A turn that comes late looks like another speed.
TEST(ResponseFit, ALateSwarmIsNotTakenForAStrongFlow) {
  for (const double turn : {0.5, 1.5, 3.0}) {
    const SwarmResponse found = fitted({}, 0, turn, 0.1);
    EXPECT_NEAR(found.speed_factor, 1, 0.1) << turn;
    EXPECT_LT(norm(found.flow), 0.1 * full_speed) << turn;
  }
}

TEST(ResponseFit, WithoutSomeTimeItIsAsCommanded) {
  ResponseFit fit(3);
  for (int k = 0; k < 4; ++k) fit.add(between_frames * k, {k * 20.0, 0}, {});
  EXPECT_EQ(fit.response(), SwarmResponse{});
  for (int k = 0; k < 200; ++k) fit.add(0.5, {k * 20.0, 0}, {});  // a frame that is seen again
  EXPECT_EQ(fit.response(), SwarmResponse{});
}

TEST(ResponseFit, AboveItsSpeedItKeepsTheCourse) {
  for (const Vec2 flow : {Vec2{0, 40}, Vec2{-40, 40}, Vec2{30, -70}}) {
    const SwarmResponse response{1, flow};
    const Command given = response.command_for({0, 80}, 80);
    EXPECT_NEAR(given.speed, 80, 1e-9);
    const Vec2 moved = response.step({{0, 0}, 0}, given, infinity, 1).position;
    EXPECT_NEAR(moved.y, 0, 1e-9) << flow.x;
    EXPECT_GT(moved.x, 0) << flow.x;
  }
  EXPECT_NEAR(SwarmResponse({1, {0, 90}}).command_for({0, 80}, 80).speed, 80, 1e-9);
}

TEST(ResponseFit, AStuckSwarmIsInNoFlow) {
  ResponseFit fit(3, 0.6 * full_speed);
  for (int k = 0; k < 50; ++k) {
    const double t = between_frames * k;
    fit.add(t, {500, 500}, {full_speed * t, 0});
  }
  EXPECT_EQ(fit.response(), SwarmResponse{});
}

TEST(ResponseFit, AResponseIsMetByItsCommand) {
  const SwarmResponse response{0.8, {5, 10}};
  const Command given = response.command_for({0.3, 40}, 100);
  const Pose2 next = response.step({{0, 0}, 0.3}, given, infinity, 1);
  EXPECT_LT(distance(next.position, 40 * unit_vector(0.3)), 1e-9);
  EXPECT_EQ(response.command_for({0.3, 0}, 100).speed, 0) << "to hold is to hold";
  EXPECT_EQ(SwarmResponse().command_for({0.3, 500}, 100).speed, 500) << "nothing to meet";
}

}  // namespace
}  // namespace microswarm::navigation
