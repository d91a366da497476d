// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/identify/response_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/rig/identify/driven_path.hpp"
#include "microswarm/rig/simulation/field_response.hpp"

namespace microswarm::rig {
namespace {

constexpr double picture_period = 0.1;  // [s]

struct Truth {
  double gain = 1;
  double angle = 0;  // [rad]
  double delay = 0;  // [s]
  double step_out = 1e9;
  Vec2 drift{};
};

/// A square in both senses, then a sweep from 8 to 24 Hz.
std::vector<DrivenCommand> programme(bool sweep) {
  std::vector<DrivenCommand> all;
  double t = 0.37;
  const auto drive = [&](double heading, double seconds, double frequency) {
    for (int i = 0; i < static_cast<int>(seconds / picture_period); ++i, t += picture_period)
      all.push_back({t, {radians(heading), 40}, frequency});
  };
  for (const double heading : {0, 90, 180, -90, 180, -90, 0, 90}) drive(heading, 3.5, 16);
  if (sweep)
    for (double f = 8; f <= 24; f += 2)
      for (const double heading : {0, 180}) drive(heading, 1.5, f);
  all.push_back({t, {0, 0}, 16});
  return all;
}

/// Turns of a body that slips above its step-out frequency, per turn of the field.
double slip_share(double f, double step_out) {
  return f > step_out ? (f - std::sqrt(f * f - step_out * step_out)) / f : 1;
}

/// What a camera sees of a swarm that answers late, turned and faster or slower.
ResponseData data_of(const Truth& truth, unsigned seed, bool sweep = true, double noise = 1.5) {
  ResponseData data;
  data.commands = programme(sweep);
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0, noise);
  std::uniform_real_distribution<double> share(0, 1);
  const DrivenPath path(data.field, data.commands, 2);
  Vec2 at{500, 700};
  double seen_at = 0, f = 16;
  std::size_t next = 0;
  for (double t = 0.002; t < data.commands.back().t + 1; t += 0.002) {
    const double then = t - truth.delay;
    while (next < data.commands.size() && data.commands[next].t <= then)
      f = data.commands[next++].frequency;
    const Vec2 moved = path.at(then) - path.at(then - 0.002);
    const double c = std::cos(truth.angle), s = std::sin(truth.angle);
    at += truth.gain * slip_share(f, truth.step_out) *
              Vec2{c * moved.x - s * moved.y, s * moved.x + c * moved.y} +
          0.002 * truth.drift;
    if (t < seen_at) continue;
    seen_at += picture_period;
    if (share(random) < 0.15) continue;  // lost pictures
    data.seen.push_back({t, at + Vec2{error(random), error(random)}});
  }
  return data;
}

TEST(ResponseFit, IntervalsOf95PercentCoverTheTruth) {
  int gain = 0, angle = 0, delay = 0, bracketed = 0;
  constexpr int trials = 100;
  std::mt19937 random(7);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  for (unsigned seed = 0; seed < trials; ++seed) {
    const Truth truth{.gain = uniform(0.5, 1.5),
                      .angle = radians(uniform(-30, 30)),
                      .delay = uniform(0, 0.3),
                      .step_out = uniform(13, 21),
                      .drift = {uniform(-1, 1), uniform(-1, 1)}};
    Truth usual = truth;
    usual.step_out =
        std::max(usual.step_out, 16.0);  // otherwise the gain is that of a slipping one
    const ResponseData data = data_of(usual, seed);
    const auto fit = fit_response(data);
    ASSERT_TRUE(fit);
    EXPECT_TRUE(doubts(*fit).empty()) << doubts(*fit).front();
    EXPECT_LT(fit->gain.error, 0.02);
    EXPECT_LT(fit->delay.error, 0.02);
    gain += std::abs(fit->gain.value - usual.gain) < 1.96 * fit->gain.error;
    angle += std::abs(fit->angle.value - usual.angle) < 1.96 * fit->angle.error;
    delay += std::abs(fit->delay.value - usual.delay) < 1.96 * fit->delay.error;
    const StepOut sweep = fit_step_out(data, *fit);
    ASSERT_GE(sweep.levels.size(), 8u);
    // A body that slips by less than 5 % of the frequency still follows.
    bracketed += sweep.followed && sweep.lost && *sweep.followed <= 1.07 * usual.step_out &&
                 *sweep.lost >= usual.step_out;
  }
  for (const int covered : {gain, angle, delay}) {
    EXPECT_GE(covered, 88);
    EXPECT_LE(covered, 100);
  }
  EXPECT_GE(bracketed, 95);
}

TEST(ResponseFit, ASweepThatNeverMeetsTheStepOutSaysSo) {
  const ResponseData data = data_of({.gain = 0.8}, 1);
  const StepOut sweep = fit_step_out(data, *fit_response(data));
  ASSERT_TRUE(sweep.followed);
  EXPECT_NEAR(*sweep.followed, 24, 1e-9);
  EXPECT_FALSE(sweep.lost);
  const ResponseData none = data_of({.gain = 0.8}, 1, false);
  EXPECT_TRUE(fit_step_out(none, *fit_response(none)).levels.empty());
}

TEST(ResponseFit, WhatCannotBeToldIsNamed) {
  ResponseData data = data_of({}, 3, false);
  // A swarm that stays.
  for (Sighting& s : data.seen) s.position = {500 + 0.01 * s.t, 700};
  ASSERT_TRUE(fit_response(data));
  EXPECT_FALSE(doubts(*fit_response(data)).empty());
  // A swarm that goes its own way.
  for (Sighting& s : data.seen) s.position = {500 + 40 * std::sin(s.t), 700 + 90 * std::cos(s.t)};
  EXPECT_FALSE(doubts(*fit_response(data)).empty());
  // One direction tells no delay.
  data = data_of({}, 3, false);
  std::erase_if(data.commands, [](const DrivenCommand& c) { return c.t > 1.5; });
  std::erase_if(data.seen, [](const Sighting& s) { return s.t > 1.5 || s.t < 0.9; });
  EXPECT_FALSE(fit_response(data));  // too few sightings
  // No command, no sighting.
  data.commands.clear();
  EXPECT_FALSE(fit_response(data));
  EXPECT_FALSE(fit_response({}));
}

TEST(ResponseFit, AnotherFrequencyIsNotPartOfTheGain) {
  const auto fit = fit_response(data_of({.gain = 0.7, .step_out = 17}, 5));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->gain.value, 0.7, 3 * fit->gain.error);
  EXPECT_LT(fit->until, 30);
}

/// Path of the field's response, step by step.
double simulated_distance(const actuation::FieldGeneratorParams& field, double speed) {
  actuation::FieldGenerator generator(field, 0);
  FieldResponse response({.kind = field.kind,
                          .frequency = field.frequency,
                          .speed_per_pitch = field.speed_per_pitch,
                          .length_per_turn = field.length_per_turn});
  generator.command({0, speed});
  double x = 0;
  for (int i = 0; i < 4000; ++i) {
    const Command moved = response.step(generator.advance(0.001), 0.001);
    x += 0.001 * moved.speed * std::cos(moved.heading);
  }
  return x;
}

TEST(DrivenPath, IsThatOfTheFieldForEachKind) {
  for (const actuation::FieldKind kind :
       {actuation::FieldKind::rotating, actuation::FieldKind::rolling}) {
    actuation::FieldGeneratorParams field{.kind = kind};
    const std::vector<DrivenCommand> commands{{0, {0, 40}, field.frequency}};
    const DrivenPath path(field, commands, 4);
    EXPECT_NEAR(path.at(4).x, simulated_distance(field, 40), 4) << static_cast<int>(kind);
    EXPECT_NEAR(path.at(4).y, 0, 1e-6);
    EXPECT_EQ(norm(path.at(-1)), 0);
  }
}

}  // namespace
}  // namespace microswarm::rig
