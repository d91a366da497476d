// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/actuation/amplifiers/coil_heat.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "tests/actuation/support.hpp"

namespace microswarm::actuation {
namespace {

AmplifierParams limited() {
  AmplifierParams d;
  d.resistance = 2;
  d.inductance = 10;
  d.temperature_coefficient = 0;
  d.thermal_resistance = 1.5;
  d.thermal_time = 20;
  d.max_current = 20;
  d.max_voltage = 30;
  d.max_slew = 1500;
  d.max_temperature = 150;
  return d;
}

TEST(Amplifiers, LeavesAloneWhatBreaksNoLimit) {
  Amplifiers amplifiers({limited(), limited()});
  const Eigen::Vector2d wanted(1, -2);
  const LimitedCurrents steady = amplifiers.steady(wanted);
  EXPECT_EQ(steady.currents, wanted);
  EXPECT_TRUE(steady.hits.empty());
  const LimitedCurrents step = amplifiers.step(wanted, 0.1);
  EXPECT_EQ(step.currents, wanted);
  EXPECT_EQ(step.scale, 1);
  EXPECT_TRUE(step.hits.empty());
  EXPECT_EQ(amplifiers.currents(), wanted);
}

TEST(Amplifiers, ScalesAsAWholeAndSaysWhatIsBroken) {
  AmplifierParams weak = limited();
  weak.max_current = 4;
  AmplifierParams strong = limited();
  strong.max_voltage.reset();
  strong.max_temperature.reset();
  const Amplifiers amplifiers({strong, weak});
  const LimitedCurrents held = amplifiers.steady(Eigen::Vector2d(30, -16));
  EXPECT_DOUBLE_EQ(held.scale, 0.25);
  EXPECT_LE((held.currents - Eigen::Vector2d(7.5, -4)).norm(), 1e-12);
  // 30 A beyond 20 A; 16 A beyond 4 A, 32 V beyond 30 V, 22 + 1.5 · 2 · 256 °C beyond 150 °C.
  ASSERT_EQ(held.hits.size(), 4u);
  EXPECT_EQ(held.hits[0].limit, AmplifierLimit::current);
  EXPECT_EQ(held.hits[0].coil, 0u);
  EXPECT_EQ(held.hits[0].asked, 30);
  EXPECT_EQ(held.hits[0].allowed, 20);
  EXPECT_EQ(held.hits[1].coil, 1u);
  EXPECT_EQ(held.hits[2].limit, AmplifierLimit::voltage);
  EXPECT_EQ(held.hits[2].asked, 32);
  EXPECT_EQ(held.hits[3].limit, AmplifierLimit::temperature);
  EXPECT_EQ(held.hits[3].asked, 22 + 1.5 * 2 * 256);
}

TEST(Amplifiers, WithoutLimitsEverythingIsAllowed) {
  Amplifiers amplifiers({AmplifierParams{}});
  const Eigen::VectorXd wanted = Eigen::VectorXd::Constant(1, 1e4);
  EXPECT_EQ(amplifiers.steady(wanted).scale, 1);
  EXPECT_EQ(amplifiers.step(wanted, 1e-3).currents, wanted);
}

/// No limit is broken while a ramp runs, checked at both of its ends.
void expect_within(const Amplifiers& after, const Eigen::VectorXd& from, double dt) {
  const AmplifierParams d = limited();
  for (Eigen::Index i = 0; i < from.size(); ++i) {
    const double to = after.currents()[i];
    const double rate = (to - from[i]) / dt;
    const double kick = 1e-3 * d.inductance * rate;
    EXPECT_LE(std::abs(to), *d.max_current * (1 + 1e-9));
    EXPECT_LE(std::abs(rate), *d.max_slew * (1 + 1e-6));
    EXPECT_LE(std::abs(d.resistance * to + kick), *d.max_voltage * (1 + 1e-6));
    EXPECT_LE(std::abs(d.resistance * from[i] + kick), *d.max_voltage * (1 + 1e-6));
    EXPECT_LE(after.temperatures()[i], *d.max_temperature + 1e-6);
  }
}

TEST(Amplifiers, NoCommandBreaksALimit) {
  test::Dice dice(11);
  int scaled = 0, turned = 0, whole = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Amplifiers amplifiers({limited(), limited(), limited()});
    for (int i = 0; i < 400; ++i) {
      const Eigen::VectorXd from = amplifiers.currents();
      const Eigen::VectorXd wanted = 12 * std::abs(dice.number()) * dice.vector();
      const double dt = std::pow(10, -2 + 1.5 * dice.number());
      const LimitedCurrents result = amplifiers.step(wanted, dt);
      EXPECT_EQ(result.currents, amplifiers.currents());
      expect_within(amplifiers, from, dt);
      if (result.keeps_direction) {
        EXPECT_LE((result.currents - result.scale * wanted).norm(), 1e-12);
        EXPECT_EQ(result.scale == 1, result.hits.empty());
        ++(result.scale < 1 ? scaled : whole);
      } else {
        EXPECT_FALSE(result.hits.empty());
        ++turned;
      }
    }
  }
  EXPECT_GT(whole, 1000);
  EXPECT_GT(scaled, 100);
  EXPECT_GT(turned, 100);
}

TEST(Amplifiers, ComesToTheCommandUnderASlewLimit) {
  Amplifiers amplifiers({limited()});
  const Eigen::VectorXd up = Eigen::VectorXd::Constant(1, 5);
  amplifiers.step(up, 1e-3);
  EXPECT_NEAR(amplifiers.currents()[0], 1.5, 1e-9);  // 1500 A/s for 1 ms
  for (int i = 0; i < 5; ++i) amplifiers.step(up, 1e-3);
  EXPECT_NEAR(amplifiers.currents()[0], 5, 1e-9);
  const LimitedCurrents back = amplifiers.step(-up, 1e-3);
  EXPECT_FALSE(back.keeps_direction);
  EXPECT_NEAR(back.currents[0], 3.5, 1e-9);
}

TEST(Amplifiers, WarmsUpAsTheThermalModelSays) {
  Amplifiers amplifiers({limited()});
  const Eigen::VectorXd current = Eigen::VectorXd::Constant(1, 5);
  amplifiers.step(current, 1e-2);
  const double start = amplifiers.temperatures()[0];
  amplifiers.step(current, 20);
  const double end = 22 + 1.5 * 2 * 25;
  EXPECT_NEAR(amplifiers.temperatures()[0], end + (start - end) * std::exp(-1), 1e-9);
  for (int i = 0; i < 30; ++i) amplifiers.step(current, 20);
  EXPECT_NEAR(amplifiers.temperatures()[0], end, 1e-6);
}

TEST(Amplifiers, HeatTakesCurrentAwayTillItCanBeHeld) {
  AmplifierParams d = limited();
  d.temperature_coefficient = 0.00393;
  d.max_voltage.reset();
  d.max_slew.reset();
  Amplifiers amplifiers({d});
  const Eigen::VectorXd current = Eigen::VectorXd::Constant(1, 20);
  EXPECT_EQ(amplifiers.step(current, 1e-2).scale,
            1);  // cold coils may carry more than the steady current
  LimitedCurrents last;
  for (int i = 0; i < 2000; ++i) {
    last = amplifiers.step(current, 0.1);
    ASSERT_LE(amplifiers.temperatures()[0], 150 + 1e-9);
  }
  EXPECT_NEAR(last.currents[0], amplifiers.steady(current).currents[0], 0.05);
  ASSERT_EQ(last.hits.size(), 1u);
  EXPECT_EQ(last.hits[0].limit, AmplifierLimit::temperature);
}

TEST(Amplifiers, ACurrentThatCanBeHeldEndsAtTheMaximumTemperature) {
  AmplifierParams d = limited();
  d.temperature_coefficient = 0.00393;
  d.max_voltage.reset();
  Amplifiers amplifiers({d});
  const Eigen::VectorXd held = amplifiers.steady(Eigen::VectorXd::Constant(1, 20)).currents;
  // (150 − 22) K = 1.5 K/W · 2 Ω · (1 + 0.00393 · 130) · I²
  EXPECT_NEAR(held[0], std::sqrt(128 / (3 * (1 + 0.00393 * 130))), 1e-9);
  for (int i = 0; i < 4000; ++i) amplifiers.step(held, 0.1);
  EXPECT_NEAR(amplifiers.temperatures()[0], 150, 1e-3);
}

/// Temperature after a ramp of the current, by many small steps of the equation itself.
double integrated(const AmplifierParams& d, double temperature, double from, double to, double dt) {
  constexpr int steps = 400;
  const double h = dt / steps;
  const auto rate = [&](double t, double T) {
    const double current = from + (to - from) * t / dt;
    const double resistance = d.resistance * (1 + d.temperature_coefficient * (T - 20));
    return (d.ambient + d.thermal_resistance * resistance * current * current - T) / d.thermal_time;
  };
  for (int k = 0; k < steps; ++k) {
    const double t = k * h;
    const double middle = temperature + 0.5 * h * rate(t, temperature);
    temperature += h * rate(t + 0.5 * h, middle);
  }
  return temperature;
}

TEST(CoilDriveLaw, IsNeverColderThanAnIndependentIntegration) {
  Rng rng(7, Purpose::test);
  for (int trial = 0; trial < 40; ++trial) {
    AmplifierParams d = limited();
    d.temperature_coefficient = rng.uniform(0, 0.01);
    d.thermal_time = rng.uniform(1, 600);
    d.thermal_resistance = rng.uniform(0.2, 4);
    Amplifiers amplifiers({d});
    double real = d.ambient;
    for (int k = 0; k < 300; ++k) {
      if (rng.below(40) == 0) {  // the program ends; the coil cools; the next one begins
        const double pause = rng.uniform(0, 100);
        Amplifiers next({d});
        next.warm(cooled({d}, amplifiers.temperatures(), pause));
        amplifiers = next;
        real = integrated(d, real, 0, 0, pause);
      }
      const double dt = rng.below(3) == 0 ? rng.uniform(1, 20) : rng.uniform(1e-3, 0.1);
      const double from = amplifiers.currents()[0];
      amplifiers.step(Eigen::VectorXd::Constant(1, rng.uniform(-20, 20)), dt);
      real = integrated(d, real, from, amplifiers.currents()[0], dt);
      ASSERT_GE(amplifiers.temperatures()[0], real - 1e-4) << trial << " " << k;
    }
  }
}

TurningCurrents turning(const Eigen::VectorXd& constant, const Eigen::VectorXd& cosine,
                        const Eigen::VectorXd& sine, double frequency) {
  return {.frequency = frequency,
          .max_frequency = std::abs(frequency),
          .constant = constant,
          .cosine = cosine,
          .sine = sine};
}

TEST(Amplifiers, NoTurnBreaksALimit) {
  test::Dice dice(12);
  const AmplifierParams d = limited();
  int scaled = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Amplifiers amplifiers({d, d, d});
    const double frequency = 20 * dice.number();
    const double omega = 2 * pi * std::abs(frequency);
    for (int i = 0; i < 300; ++i) {
      const TurningCurrents before = amplifiers.turning();
      const double size = 20 * std::abs(dice.number());
      const double dt = std::pow(10, -2 + dice.number());
      TurningCurrents wanted = turning(0.1 * size * dice.vector(), size * dice.vector(),
                                       size * dice.vector(), frequency);
      wanted.phase = before.phase + 2 * pi * frequency * dt;
      scaled += amplifiers.turn(wanted, dt) < 1;
      const TurningCurrents& now = amplifiers.turning();
      for (Eigen::Index c = 0; c < 3; ++c) {
        const double A = std::hypot(now.cosine[c], now.sine[c]);
        const double rate =
            (std::abs(now.constant[c] - before.constant[c]) +
             std::hypot(now.cosine[c] - before.cosine[c], now.sine[c] - before.sine[c])) /
            dt;
        EXPECT_LE(std::abs(now.constant[c]) + A, *d.max_current * (1 + 1e-9));
        EXPECT_LE(omega * A + rate, *d.max_slew * (1 + 1e-9));
        EXPECT_LE(d.resistance * std::abs(now.constant[c]) +
                      A * std::hypot(d.resistance, 1e-3 * d.inductance * omega) +
                      1e-3 * d.inductance * rate,
                  *d.max_voltage * (1 + 1e-9));
        EXPECT_LE(amplifiers.temperatures()[c], *d.max_temperature + 1e-6);
      }
    }
  }
  EXPECT_GT(scaled, 1000);
}

TEST(Amplifiers, ATurnThatIsTooHotIsScaledWithoutChangingItsShape) {
  AmplifierParams d = limited();
  d.max_voltage.reset();
  d.max_slew.reset();
  Amplifiers amplifiers({d});
  const auto one = [](double value) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, value));
  };
  double scale = 1;
  for (int i = 0; i < 20000; ++i) {
    TurningCurrents wanted = turning(one(0), one(16), one(12), 16);
    wanted.phase = amplifiers.turning().phase + 2 * pi * 16 * 0.01;
    scale = amplifiers.turn(wanted, 0.01);
    ASSERT_LE(amplifiers.temperatures()[0], 150 + 1e-9);
  }
  // The mean square of a turn is half of the amplitude's: (150 − 22) K = 1.5 K/W · 2 Ω · A² / 2.
  EXPECT_NEAR(20 * scale, std::sqrt(2 * 128 / 3.0), 0.6);
  EXPECT_NEAR(amplifiers.turning().cosine[0] / amplifiers.turning().sine[0], 4.0 / 3, 1e-9);
}

TEST(CoilDriveLaw, ATurnIsNeverColderThanAnIndependentIntegration) {
  Rng rng(8, Purpose::test);
  const auto one = [](double value) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, value));
  };
  for (int trial = 0; trial < 40; ++trial) {
    AmplifierParams d = limited();
    d.max_slew.reset();
    d.temperature_coefficient = rng.uniform(0, 0.01);
    d.thermal_time = rng.uniform(5, 600);
    d.thermal_resistance = rng.uniform(0.2, 4);
    Amplifiers amplifiers({d});
    const double frequency = rng.uniform(-100, 100);
    double real = d.ambient;
    for (int k = 0; k < 200; ++k) {
      const double dt = rng.uniform(1e-3, 0.03);
      TurningCurrents wanted = turning(one(rng.uniform(-2, 2)), one(rng.uniform(-15, 15)),
                                       one(rng.uniform(-15, 15)), frequency);
      const TurningCurrents before = amplifiers.turning();
      wanted.phase = before.phase + 2 * pi * frequency * dt;
      amplifiers.turn(wanted, dt);
      constexpr int steps = 400;
      const double h = dt / steps;
      const TurningCurrents& now = amplifiers.turning();
      for (int m = 0; m < steps; ++m) {  // the device follows the new currents at once
        const double angle = before.phase + 2 * pi * frequency * (m + 0.5) * h;
        const double current =
            now.constant[0] + now.cosine[0] * std::cos(angle) + now.sine[0] * std::sin(angle);
        const double resistance = d.resistance * (1 + d.temperature_coefficient * (real - 20));
        real += h * (d.ambient + d.thermal_resistance * resistance * current * current - real) /
                d.thermal_time;
      }
      ASSERT_GE(amplifiers.temperatures()[0], real - 5e-3) << trial << " " << k;
    }
  }
}

TEST(CoilHeat, TimeToTheLimitIsThatOfTheHeating) {
  AmplifierParams d = limited();
  d.temperature_coefficient = 0.00393;
  d.max_temperature = 90;
  for (const double mean_square : {30.0, 60.0, 300.0, 1e4})
    for (const double from : {22.0, 60.0, 89.0}) {
      const double time = time_to_limit(d, from, mean_square);
      ASSERT_TRUE(std::isfinite(time));
      EXPECT_NEAR(temperature_later(d, from, mean_square, time), 90, 1e-6);
      double now = from;  // in small steps
      constexpr int steps = 1000;
      for (int i = 0; i < steps; ++i) now = temperature_later(d, now, mean_square, time / steps);
      EXPECT_NEAR(now, 90, 1e-6);
    }
  EXPECT_EQ(time_to_limit(d, 90, 30), 0);
  EXPECT_EQ(time_to_limit(d, 95, 30), 0);
  EXPECT_EQ(time_to_limit(d, 22, 1), infinity);
  d.max_temperature.reset();
  EXPECT_EQ(time_to_limit(d, 22, 1e4), infinity);
}

}  // namespace
}  // namespace microswarm::actuation
