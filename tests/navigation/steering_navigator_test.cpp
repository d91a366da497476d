// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/steering_navigator.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

Observation sighting(const Snapshot& world, Vec2 at, double now, double age) {
  return {.now = now,
          .seen = now - age,
          .swarm = SwarmPose{{at, 0}, 40},
          .robots = {},
          .world = borrowed(world)};
}

/// Gives a command and keeps what it is given.
class Probe final : public SteeringNavigator {
 public:
  explicit Probe(double lag = 0, double speed = 50, double turn_rate = 3)
      : SteeringNavigator(
            body_task(
                {.radius = 40, .max_speed = 70, .max_turn_rate = turn_rate, .response_lag = lag}),
            speed) {}
  using SteeringNavigator::delay;
  using SteeringNavigator::estimate_swarm;
  using SteeringNavigator::last_command;
  using SteeringNavigator::speed;

  /// The state of a step, and the pose given to it.
  NavigatorState state_after(const Observation& seen) {
    pose.reset();
    given = step(seen, {});
    return view().state;
  }

  Command command{0, 50};
  Command given;
  std::optional<Pose2> pose;

 private:
  Decision decide(const Moment& moment) override {
    pose = moment.pose;
    return {command, NavigatorState::follow};
  }
};

// Obstacles are predicted for the delay: then they are where they will be when the swarm is at the
// pose.
TEST(SteeringNavigator, TheDelayIsTheTimeToThePoseAtEffect) {
  const Snapshot world = room_with();
  for (const double age : {0.0, 0.05, 0.2})
    for (const double lag : {0.0, 0.1, 0.3}) {
      Probe probe(lag);
      for (int k = 0; k <= 20; ++k) {
        const Vec2 at{300 + 5.0 * k, 500};
        ASSERT_EQ(probe.state_after(sighting(world, at, 0.1 * k, age)), NavigatorState::follow);
        if (k < 20) continue;
        EXPECT_NEAR(probe.pose->position.x - at.x, 50 * probe.delay(), 1e-9) << age << ", " << lag;
        EXPECT_NEAR(probe.delay(), age + lag, 1e-12);
      }
    }
}

TEST(SteeringNavigator, ACommandGivenInItsPlaceCountsAsItsOwn) {
  const Snapshot world = room_with();
  Probe probe(0.3);
  EXPECT_FALSE(probe.last_command());
  probe.overruled(0, {0, 0});
  probe.overruled(1, {0, 50});
  EXPECT_EQ(probe.last_command(), 1);
  probe.command = {0, 20};
  probe.step(sighting(world, {300, 500}, 1.1, 0), {});
  ASSERT_TRUE(probe.pose);
  EXPECT_NEAR(probe.pose->position.x, 300 + 50 * 0.1, 1e-9);
  EXPECT_EQ(probe.last_command(), 1.1);
  probe.step(sighting(world, {305, 500}, 1.3, 0), {});
  EXPECT_NEAR(probe.pose->position.x, 305 + 50 * 0.1 + 20 * 0.2, 1e-9);
  probe.overruled(1.3, {0, 0});
  probe.step(sighting(world, {314, 500}, 1.6, 0), {});
  EXPECT_NEAR(probe.pose->position.x, 314, 1e-9);
}

/// The last tick of a swarm that a flow carries for 6 s, while `wanted` is commanded along +x. A
/// frame is a tick old, and a command takes effect a tick late.
struct InFlow {
  Vec2 velocity;    ///< of the swarm [µm/s]
  Vec2 error;       ///< of the pose at effect [µm]
  Command command;  ///< given
};

InFlow drive_in(Vec2 flow, double wanted) {
  constexpr double tick = 0.1;
  const Snapshot world = room_with();
  Probe probe(tick, 60, infinity);
  probe.estimate_swarm(3);
  probe.command = {0, wanted};
  InFlow last;
  Vec2 at{300, 500}, before = at;
  Command in_effect{0, 0};
  for (int k = 0; k < 60; ++k) {
    probe.state_after(sighting(world, before, tick * k, tick));
    before = at;
    last.velocity = in_effect.speed * unit_vector(in_effect.heading) + flow;
    at += tick * last.velocity;
    last.error = probe.pose->position - at;
    last.command = in_effect = probe.given;
  }
  return last;
}

TEST(SteeringNavigator, AnEstimatedFlowIsMetByTheCommands) {
  for (const Vec2 flow : {Vec2{0, 15}, Vec2{-15, 0}, Vec2{10, -10}}) {
    const InFlow met = drive_in(flow, 40);
    EXPECT_NEAR(met.velocity.x, 40, 0.01) << flow.x << ", " << flow.y;
    EXPECT_NEAR(met.velocity.y, 0, 0.01) << flow.x << ", " << flow.y;
    EXPECT_NEAR(norm(met.error), 0, 0.01) << flow.x << ", " << flow.y;
  }
  const InFlow strong = drive_in({-30, 0}, 40);
  EXPECT_NEAR(strong.command.speed, 60, 1e-6) << "the limit of its speed";
  EXPECT_NEAR(strong.command.heading, 0, 0.001);
  EXPECT_EQ(drive_in({0, 15}, 0).command.speed, 0) << "to hold is to hold";
  EXPECT_EQ(drive_in({-40, 0}, 40).velocity.x, 0) << "what does not move is stuck, not in a flow";
  EXPECT_NEAR(drive_in({30, 0}, 30).command.speed, 0, 0.01) << "the flow does what is wanted";
}

TEST(SteeringNavigator, HoldsAtTheGoalAndWithoutASwarm) {
  const Snapshot world = room_with();
  Probe probe(0, 100);
  EXPECT_EQ(probe.speed(), 70) << "is never faster than the swarm";
  probe.command = {0, 0};
  EXPECT_EQ(probe.state_after(sighting(world, room_goal + Vec2{29, 0}, 0, 0)),
            NavigatorState::arrived);
  EXPECT_EQ(probe.given.speed, 0);
  EXPECT_EQ(probe.state_after(sighting(world, room_goal + Vec2{31, 0}, 0.1, 0)),
            NavigatorState::follow);
  EXPECT_EQ(probe.state_after(sighting(world, {300, 500}, 3, 2.5)), NavigatorState::blind)
      << "the frame is too old";
  EXPECT_EQ(probe.given.speed, 0);
}

TEST(SteeringNavigator, SeesASwarmWhoseEveryNumberIsGood) {
  const Snapshot world =
      room_with({Polygon{{{900, 400}, {1000, 400}, {1000, 600}, {900, 600}}, {}}});
  const auto sees = [](const Observation& seen) {
    return Probe().state_after(seen) != NavigatorState::blind;
  };
  const Observation good = sighting(world, {300, 500}, 1, default_frame_timeout);
  EXPECT_TRUE(sees(good));
  EXPECT_TRUE(sees(sighting(world, {899.5, 500}, 1, 0))) << "beside a wall";
  const auto sees_changed = [&](auto&& change) {
    Observation bad = good;
    change(bad);
    return sees(bad);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(sees_changed([](Observation& o) { o.swarm.reset(); }));
  EXPECT_FALSE(sees_changed([](Observation& o) { o.world = nullptr; }));
  EXPECT_FALSE(sees_changed([](Observation& o) { o.swarm->pose.position.x = nan; }));
  EXPECT_FALSE(sees_changed([](Observation& o) { o.swarm->pose.position.y = infinity; }));
  EXPECT_FALSE(sees_changed([](Observation& o) { o.swarm->pose.heading = nan; }));
  EXPECT_FALSE(sees_changed([](Observation& o) { o.swarm->radius = infinity; }));
  EXPECT_FALSE(sees_changed([](Observation& o) { o.seen -= 0.01; })) << "too old";
  EXPECT_FALSE(sees_changed([](Observation& o) {
    o.swarm->pose.position = {950, 500};
  })) << "in a wall";
}

}  // namespace
}  // namespace microswarm::navigation
