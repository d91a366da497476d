// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/field/waveform.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

#include "microswarm/actuation/field/field_generator.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "tests/actuation/support.hpp"

namespace microswarm::actuation {
namespace {

TEST(Waveform, RotatingFieldTurnsSquareToItsAxis) {
  test::Dice dice(7);
  for (int trial = 0; trial < 100; ++trial) {
    const double heading = pi * dice.number(), pitch = dice.number(), phase = 9 * dice.number();
    const Eigen::Vector3d axis(std::sin(pitch) * std::cos(heading),
                               std::sin(pitch) * std::sin(heading), std::cos(pitch));
    EXPECT_NEAR(rotating_field(8, pitch, heading, phase).dot(axis), 0, 1e-12);
    EXPECT_EQ(rotating_field(8, 0, heading, phase).z(), 0);
  }
}

TEST(Waveform, KeepsItsStrengthInEveryForm) {
  test::Dice dice(8);
  for (int trial = 0; trial < 100; ++trial) {
    const double heading = pi * dice.number(), phase = 9 * dice.number(), pitch = dice.number();
    EXPECT_NEAR(rotating_field(5, pitch, heading, phase).norm(), 5, 1e-12);
    EXPECT_NEAR(rolling_field(5, heading, phase).norm(), 5, 1e-12);
    EXPECT_NEAR(steering_field(5, heading).norm(), 5, 1e-12);
    EXPECT_NEAR(oscillating_field(5, pitch, heading, phase).norm(), 5 * std::abs(std::cos(phase)),
                1e-12);
  }
  EXPECT_EQ(oscillating_field(10, 0, 1, 0.5).z(), 0);
}

TEST(Waveform, RollsForwards) {
  // A body that turns with the field about ω rolls on a floor along ω × up.
  for (const double heading : {0.0, 1.0, -2.5}) {
    const Eigen::Vector3d now = rolling_field(1, heading, 0.3);
    const Eigen::Vector3d omega = now.cross(rolling_field(1, heading, 0.3 + 1e-6)) / 1e-6;
    const Eigen::Vector3d way = omega.cross(Eigen::Vector3d::UnitZ());
    EXPECT_LE((way - steering_field(1, heading)).norm(), 1e-5);
  }
}

TEST(Waveform, RolledWayIsThatOfTheShortestTurn) {
  // Whole turns in the plane of rolling: a length each.
  for (const double heading : {0.0, 1.0, -2.5}) {
    Vec2 way;
    for (int i = 0; i < 400; ++i)
      way += rolled_distance(rolling_field(3, heading, 0.05 * pi * i),
                             rolling_field(3, heading, 0.05 * pi * (i + 1)), 16);
    EXPECT_LE(distance(way, 160 * unit_vector(heading)), 1e-9);
  }
  // Steering in the plane moves nothing, nor does a field that only grows.
  EXPECT_LE(norm(rolled_distance(steering_field(3, 0.2), steering_field(3, 1.2), 16)), 1e-12);
  EXPECT_EQ(rolled_distance(steering_field(3, 1), 2 * steering_field(3, 1), 16), (Vec2{}));
  // A raised field that is steered moves the body across: R sin φ cos φ for each radian.
  const double turn = 1e-4, raised = 0.6;
  const Vec2 across =
      rolled_distance(rolling_field(1, 0, -raised), rolling_field(1, turn, -raised), 2 * pi);
  EXPECT_LE(distance(across, Vec2{0, turn * std::sin(raised) * std::cos(raised)}), 1e-7);
}

TEST(Waveform, PlanIsOneFieldWithoutAJump) {
  test::Dice dice(9);
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<Move> moves;
    for (int i = 0; i < 12; ++i)
      moves.push_back({2 * pi * dice.number(), 3000 * (1 + dice.number())});
    const RollingParams params{.amplitude = 3, .frequency = 2, .length_per_turn = 700};
    const RollingPlan plan = rolling_plan(moves, 0.4, params);
    const Waveform& w = plan.waveform;
    EXPECT_EQ(w.at(0), steering_field(3, 0.4));
    // Across every joint the field is the same to rounding …
    for (const WaveformPiece& piece : w.pieces()) {
      const double end = piece.start + piece.duration;
      const double before = std::nextafter(end, -1.0);
      EXPECT_LE((w.at(end) - w.at(before)).norm(), 1e-11) << trial;
    }
    // … and nowhere faster than it turns.
    const double step = w.duration() / 20000;
    for (int i = 0; i < 20000; ++i)
      EXPECT_LE((w.at((i + 1) * step) - w.at(i * step)).norm(), 3 * 2 * pi * 2 * step * (1 + 1e-9));
    EXPECT_LE((w.at(w.duration()) - steering_field(3, w.pieces().back().heading)).norm(), 1e-12);
    EXPECT_LE((w.at(w.duration() + 100) - w.at(w.duration())).norm(), 1e-11);
    EXPECT_EQ(w.at(-1), w.at(0));
  }
}

TEST(Waveform, PlanRollsWholeTurnsAlongEachHeading) {
  const std::vector<Move> moves{{0, 2100}, {pi / 2, 400}, {-pi / 2, 1000}, {-pi / 2, 3000}};
  const RollingPlan plan = rolling_plan(moves, pi, {.frequency = 5, .length_per_turn = 1000});
  EXPECT_EQ(plan.rolls, (std::vector<int>{2, 0, 1, 3}));
  double rolled = 0, steered = 0;
  for (const WaveformPiece& piece : plan.waveform.pieces()) {
    rolled += piece.rolls;
    steered += std::abs(piece.turn);
  }
  EXPECT_EQ(rolled, 6);
  EXPECT_NEAR(steered, pi + pi / 2, 1e-12);
  EXPECT_NEAR(plan.waveform.duration(), 6.0 / 5 + 1.5 * pi / (pi / 2), 1e-12);
  EXPECT_EQ(plan.waveform.sample(100).size(),
            static_cast<std::size_t>(std::floor(plan.waveform.duration() * 100)) + 1);
  EXPECT_EQ(rolling_plan({}, 1, {}).waveform.duration(), 0);
  EXPECT_EQ(rolling_plan({}, 1, {}).waveform.at(3), steering_field(3, 1));
}

class Generator : public testing::TestWithParam<FieldKind> {};

TEST_P(Generator, NeverJumpsWhateverIsCommanded) {
  FieldGeneratorParams params;
  params.kind = GetParam();
  FieldGenerator generator(params, 0);
  test::Dice dice(10);
  Eigen::Vector3d last = generator.field();
  const double dt = 1e-4;
  for (int i = 0; i < 20000; ++i) {
    if (i % 1000 == 0) generator.command({pi * dice.number(), 150 * (1 + dice.number())});
    const Eigen::Vector3d next = generator.advance(dt);
    ASSERT_LE((next - last).norm(), generator.max_rate() * dt * (1 + 1e-9)) << i;
    ASSERT_LE(generator.pitch(), params.max_pitch);
    ASSERT_LE(generator.frequency(), params.frequency);
    last = next;
  }
}

TEST_P(Generator, ComesToTheCommandAndHolds) {
  FieldGeneratorParams params;
  params.kind = GetParam();
  FieldGenerator generator(params, 3);
  generator.command({-3, 40});
  generator.advance(0.01);
  EXPECT_NEAR(turn_between(generator.heading(), 3), 2 * pi * 0.01, 1e-9);  // the shorter way
  for (int i = 0; i < 100; ++i) generator.advance(0.01);
  EXPECT_NEAR(turn_between(generator.heading(), -3), 0, 1e-4);
  if (GetParam() == FieldKind::rolling) {
    EXPECT_NEAR(generator.frequency(), 2, 1e-6);
  } else {
    EXPECT_NEAR(generator.pitch(), radians(2), 1e-9);
    EXPECT_EQ(generator.frequency(), 16);
  }
  generator.command({1, 0});
  for (int i = 0; i < 100; ++i) generator.advance(0.01);
  EXPECT_NEAR(turn_between(generator.heading(), -3), 0, 1e-4);
  EXPECT_EQ(generator.pitch(), 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Generator,
                         testing::Values(FieldKind::rotating, FieldKind::rolling,
                                         FieldKind::oscillating));

// A rolling field makes the way that is commanded, whatever turns are between.
TEST(FieldGenerator, RollsTheWayThatIsCommanded) {
  const FieldGeneratorParams params{.kind = FieldKind::rolling,
                                    .amplitude = 5,
                                    .frequency = 5,
                                    .length_per_turn = 16,
                                    .max_turn_rate = radians(1800)};
  test::Dice dice(11);
  FieldGenerator generator(params, 0);
  Vec2 commanded, rolled;
  double worst = 0, mean = 0;
  constexpr int commands = 2000;
  for (int k = 0; k < commands; ++k) {
    const Command command{pi * std::round(4 * dice.number()) / 4, 50};  // one of eight ways
    generator.command(command);
    for (int i = 0; i < 10; ++i) {
      const Eigen::Vector3d before = generator.field();
      rolled += rolled_distance(before, generator.advance(0.01), params.length_per_turn);
    }
    commanded += displacement(command, 0.1);
    const double off = distance(commanded, rolled);
    worst = std::max(worst, off);
    mean += off / commands;
  }
  EXPECT_LE(worst, 2.5);
  EXPECT_LE(mean, 0.6);
  generator.command({0, 0});  // holds at once
  const Eigen::Vector3d held = generator.field();
  EXPECT_LT((generator.advance(0.01) - held).norm(), 1e-12);
}

// What fast turns owe is neither made up for in haste nor after a hold.
TEST(FieldGenerator, RollsSlowlyWhenSlownessIsCommanded) {
  FieldGeneratorParams params;
  params.kind = FieldKind::rolling;
  for (const bool hold : {false, true}) {
    FieldGenerator generator(params, 0);
    generator.command({pi / 2, 200});
    for (int i = 0; i < 5; ++i) generator.advance(0.01);
    if (hold) {
      generator.command({0, 0});
      for (int i = 0; i < 5; ++i) generator.advance(0.01);
    }
    generator.command({pi / 2, 1});
    for (int i = 0; i < 100; ++i) {
      generator.advance(0.01);
      EXPECT_LE(std::abs(generator.frequency()), 2 / params.length_per_turn * (1 + 1e-9));
    }
  }
}

TEST(FieldGenerator, RollsBackwardsRatherThanTurnRound) {
  FieldGeneratorParams params;
  params.kind = FieldKind::rolling;
  FieldGenerator generator(params, 0.5);
  generator.command({0.5 - pi, 40});
  const Eigen::Vector3d before = generator.field();
  const Vec2 way = rolled_distance(before, generator.advance(0.01), params.length_per_turn);
  EXPECT_LE(distance(way, 0.4 * unit_vector(0.5 - pi)), 1e-9);
  EXPECT_NEAR(generator.heading(), 0.5, 1e-9);
  EXPECT_LT(generator.frequency(), 0);
}

TEST(FieldGenerator, KeepsItsPhaseWhenTheFrequencyChanges) {
  FieldGeneratorParams params;
  params.kind = FieldKind::rolling;
  FieldGenerator generator(params, 0);
  generator.command({0, 20});  // 1 Hz
  for (int i = 0; i < 10; ++i) generator.advance(0.01);
  generator.command({0, 100});  // 5 Hz
  for (int i = 0; i < 5; ++i) generator.advance(0.01);
  EXPECT_NEAR(generator.phase(), 2 * pi * (0.1 + 0.25), 1e-12);
  generator.command({0, 0});
  const Eigen::Vector3d held = generator.field();
  EXPECT_EQ(generator.advance(5), held);
}

}  // namespace
}  // namespace microswarm::actuation
