// SPDX-License-Identifier: Apache-2.0
// Laws that every swarm seen as one body keeps.
#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/swarm/body/swarm_body.hpp"
#include "tests/laws/fields_laws.hpp"

namespace microswarm {
namespace {

struct BodyCase {
  std::string name;
  SwarmParams params;
};

void PrintTo(const BodyCase& c, std::ostream* os) { *os << c.name; }

std::vector<BodyCase> quiet_bodies() {
  return {{"Ribbon", RibbonParams{}},
          {"RibbonAtOnce", RibbonParams{.max_turn_rate = 8, .response_lag = 0}},
          {"RibbonSluggish", RibbonParams{.max_turn_rate = 0.4, .response_lag = 0.73}},
          {"Vortex", VortexParams{.moving_radius = 350}},
          {"VortexBreathing", VortexParams{.radius = 300, .moving_radius = 420, .radius_lag = 0.7}},
          {"VortexAtOnce", VortexParams{.radius = 40, .moving_radius = 20, .response_lag = 0}}};
}

/// With what no navigator is told.
std::vector<BodyCase> real_bodies() {
  std::vector<BodyCase> all = quiet_bodies();
  all.push_back({"RibbonNoisy", RibbonParams{.position_noise = 3, .heading_noise = 0.2}});
  all.push_back({"RibbonCarried", RibbonParams{.drift = {5, -3}, .speed_factor = 1.2}});
  all.push_back({"VortexNoisy", VortexParams{.radius_ripple = 30, .position_noise = 4}});
  return all;
}

const Pose2 begin{{100, -50}, 0.6};

/// Commands for some seconds, some of which ask for too much, some for nothing.
std::vector<Command> random_commands(const SwarmParams& params, int count = 80) {
  Rng rng(17, Purpose::test);
  std::vector<Command> out;
  for (int i = 0; i < count; ++i) {
    const double heading = rng.uniform(-9, 9);
    const double speed = rng.uniform(-0.2, 1.4) * swarm_limits(params).max_speed;
    out.push_back({heading, rng.below(5) == 0 ? 0 : speed});
  }
  return out;
}

void add(Hash& hash, const SwarmBody& body) {
  const SwarmPose p = body.pose();
  for (const double v : {p.pose.position.x, p.pose.position.y, p.pose.heading, p.radius})
    hash.value(v);
}

class SwarmBodyLaws : public testing::TestWithParam<BodyCase> {
 protected:
  SwarmParams params() const { return GetParam().params; }
  SwarmLimits limits() const { return swarm_limits(params()); }
};

TEST_P(SwarmBodyLaws, SameStreamSameBits) {
  const auto digest = [&] {
    SwarmBody body(params(), begin);
    Rng rng(3, Purpose::plant);
    Hash hash;
    for (const Command& c : random_commands(params())) {
      body.step(c, 0.1, rng);
      add(hash, body);
    }
    return hash.hex();
  };
  EXPECT_EQ(digest(), digest());
}

TEST_P(SwarmBodyLaws, ACopyGoesOnAlone) {
  SwarmBody body(params(), begin);
  Rng rng(3, Purpose::plant);
  const std::vector<Command> commands = random_commands(params());
  for (std::size_t i = 0; i < 20; ++i) body.step(commands[i], 0.1, rng);
  SwarmBody copy = body;
  Rng same = rng;
  Hash one, two;
  for (std::size_t i = 20; i < commands.size(); ++i) body.step(commands[i], 0.1, rng);
  for (std::size_t i = 20; i < commands.size(); ++i) copy.step(commands[i], 0.1, same);
  add(one, body);
  add(two, copy);
  EXPECT_EQ(one.hex(), two.hex());
}

TEST_P(SwarmBodyLaws, BeginsWhereItIsToldTo) {
  const SwarmBody body(params(), begin);
  EXPECT_EQ(body.pose().pose, begin);
  EXPECT_EQ(body.speed(), 0);
  EXPECT_GT(body.pose().radius, 0);
  EXPECT_LE(body.pose().radius, limits().radius);
}

TEST_P(SwarmBodyLaws, SweptRunsFromTheOldPoseToTheNew) {
  SwarmBody body(params(), begin);
  Rng rng(3, Purpose::plant);
  for (const double dt : {0.1, 0.013, 0.5, 0.004})
    for (const Command& c : random_commands(params(), 10)) {
      const SwarmPose before = body.pose();
      body.step(c, dt, rng);
      const auto swept = body.trajectory();
      ASSERT_GE(swept.size(), 2u);
      EXPECT_EQ(swept.front().t, 0);
      EXPECT_EQ(swept.front().pose, before.pose);
      EXPECT_EQ(swept.front().radius, before.radius);
      EXPECT_EQ(swept.back().t, dt);
      EXPECT_EQ(swept.back().pose, body.pose().pose);
      EXPECT_EQ(swept.back().radius, body.pose().radius);
      for (std::size_t i = 1; i < swept.size(); ++i) {
        EXPECT_GT(swept[i].t, swept[i - 1].t);
        EXPECT_LE(swept[i].t - swept[i - 1].t, 0.01 + 1e-9);
      }
    }
}

TEST_P(SwarmBodyLaws, RadiusStaysWithinItsLimits) {
  SwarmBody body(params(), begin);
  Rng rng(3, Purpose::plant);
  for (const Command& c : random_commands(params(), 300)) {
    body.step(c, 0.1, rng);
    for (const PoseStamped& p : body.trajectory()) {
      ASSERT_LE(p.radius, limits().radius + 1e-9);
      ASSERT_GE(p.radius, limits().radius - limits().radius_variation - 1e-9);
      ASSERT_GT(p.radius, 0);
    }
  }
}

TEST_P(SwarmBodyLaws, StaysFiniteWhateverIsAskedFor) {
  SwarmBody body(params(), begin);
  Rng rng(3, Purpose::plant);
  for (const Command& c : {Command{1e9, 1e12}, {-1e9, -1e12}, {0, 1e300}, {pi, 1e-300}, {0, 0}})
    for (const double dt : {1e-6, 0.1, 5.0}) {
      body.step(c, dt, rng);
      const SwarmPose p = body.pose();
      ASSERT_TRUE(is_finite(p.pose.position));
      ASSERT_LE(std::abs(p.pose.heading), pi);
      ASSERT_TRUE(std::isfinite(p.radius));
      ASSERT_GE(body.speed(), 0);
    }
}

TEST_P(SwarmBodyLaws, ReadsBack) { laws::expect_reads_back(params()); }
TEST_P(SwarmBodyLaws, LimitsAreKept) { EXPECT_GT(laws::expect_limits_are_kept(params()), 8); }

INSTANTIATE_TEST_SUITE_P(All, SwarmBodyLaws, testing::ValuesIn(real_bodies()),
                         [](const auto& c) { return c.param.name; });

/// Without noise and flow, so that it does what it is told and nothing else.
class QuietBodyLaws : public SwarmBodyLaws {};

TEST_P(QuietBodyLaws, HoldHolds) {
  SwarmBody body(params(), begin);
  Rng rng(3, Purpose::plant);
  for (const double heading : {0.0, 2.0, -3.0}) {
    body.step({heading, 0}, 0.5, rng);
    EXPECT_EQ(body.pose().pose, begin);
    EXPECT_EQ(body.speed(), 0);
  }
  // And after it moved, once the commands on their way have taken effect.
  body.step({1, 0.5 * limits().max_speed}, 0.5, rng);
  body.step({1, 0}, limits().response_lag, rng);
  const Pose2 stopped = body.pose().pose;
  EXPECT_GT(distance(stopped.position, begin.position), 0);
  body.step({-2, 0}, 3, rng);
  EXPECT_EQ(body.pose().pose, stopped);
}

TEST_P(QuietBodyLaws, SpeedAndTurningStayWithinTheirLimits) {
  SwarmBody body(params(), begin);
  Rng rng(3, Purpose::plant);
  for (const Command& c : random_commands(params(), 200)) {
    body.step(c, 0.1, rng);
    ASSERT_LE(body.speed(), limits().max_speed);
    const auto swept = body.trajectory();
    for (std::size_t i = 1; i < swept.size(); ++i) {
      const double dt = swept[i].t - swept[i - 1].t;
      ASSERT_LE(distance(swept[i].pose.position, swept[i - 1].pose.position),
                limits().max_speed * dt + 1e-9);
      ASSERT_LE(turn_between(swept[i].pose.heading, swept[i - 1].pose.heading),
                limits().max_turn_rate * dt + 1e-9);
    }
  }
}

// Straight pieces round a bend differ by their length's square at most.
TEST_P(QuietBodyLaws, TwoHalvesAreOneStep) {
  for (const double dt : {0.1, 0.07, 0.5}) {
    SwarmBody whole(params(), begin), halves(params(), begin);
    Rng rng(3, Purpose::plant);
    for (const Command& c : random_commands(params())) {
      whole.step(c, dt, rng);
      halves.step(c, dt / 2, rng);
      halves.step(c, dt / 2, rng);
      ASSERT_LE(distance(whole.pose().pose.position, halves.pose().pose.position),
                1e-3 * limits().max_speed);
      ASSERT_LE(turn_between(whole.pose().pose.heading, halves.pose().pose.heading), 1e-9);
      ASSERT_NEAR(whole.pose().radius, halves.pose().radius, 1e-6 * limits().radius);
    }
  }
}

TEST_P(QuietBodyLaws, TheDeadTimeShiftsEverything) {
  const double lag = limits().response_lag;
  SwarmParams at_once = params();
  std::visit([](auto& p) { p.response_lag = 0; }, at_once);
  SwarmBody late(params(), begin), prompt(at_once, begin);
  Rng rng(3, Purpose::plant);
  if (lag > 0) late.step({0, 0}, lag, rng);
  EXPECT_EQ(late.pose().pose, begin);
  // Given one after the other, what was given `lag` ago is in effect.
  const std::vector<Command> commands = random_commands(params(), 40);
  for (const Command& c : commands) {
    late.step(c, 0.1, rng);
    prompt.step(c, 0.1, rng);
  }
  if (lag > 0) late.step(commands.back(), lag, rng);
  // The first hold was longer by the lag: it changes nothing.
  EXPECT_LE(distance(late.pose().pose.position, prompt.pose().pose.position),
            1e-3 * limits().max_speed);
  EXPECT_LE(turn_between(late.pose().pose.heading, prompt.pose().pose.heading), 1e-9);
}

TEST_P(QuietBodyLaws, AllDirectionsAreAlike) {
  for (const double turned : {0.3, 1.9, -2.7}) {
    SwarmBody one(params(), begin);
    SwarmBody other(params(), {rotated(begin.position, turned), wrap(begin.heading + turned)});
    Rng rng(3, Purpose::plant);
    for (const Command& c : random_commands(params())) {
      one.step(c, 0.1, rng);
      other.step({c.heading + turned, c.speed}, 0.1, rng);
      ASSERT_LE(distance(rotated(one.pose().pose.position, turned), other.pose().pose.position),
                1e-8);
      ASSERT_NEAR(one.pose().radius, other.pose().radius, 1e-9);
    }
  }
}

TEST_P(QuietBodyLaws, ComesToTheSpeedThatIsCommanded) {
  for (const double share : {0.1, 0.5, 1.0}) {
    SwarmBody body(params(), begin);
    Rng rng(3, Purpose::plant);
    const Command ahead{begin.heading, share * limits().max_speed};
    body.step(ahead, limits().response_lag + 0.1, rng);
    EXPECT_NEAR(body.speed(), ahead.speed, 1e-9);
    const Vec2 from = body.pose().pose.position;
    body.step(ahead, 2, rng);
    EXPECT_LE(
        distance(body.pose().pose.position, from + 2 * ahead.speed * unit_vector(begin.heading)),
        1e-6);
  }
}

TEST_P(QuietBodyLaws, DrawsNoRandomNumbers) {
  SwarmBody body(params(), begin);
  Rng rng(3, Purpose::plant);
  Rng untouched = rng;
  for (const Command& c : random_commands(params(), 10)) body.step(c, 0.1, rng);
  EXPECT_EQ(rng.bits(), untouched.bits());
}

INSTANTIATE_TEST_SUITE_P(All, QuietBodyLaws, testing::ValuesIn(quiet_bodies()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace microswarm
