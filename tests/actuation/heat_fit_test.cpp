// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/heat_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
namespace {

/// What a log of a known coil is made with.
struct Heating {
  double current = 3;     ///< [A]
  double seconds = 1200;  ///< with the current, then with a tenth of it
  double every = 30;      ///< [s]
  double noise = 0;       ///< of the voltage, relative
  bool voltage = true;
  double probe_noise = -1;  ///< [K]; negative: no probe
};

HeatLog heat_log(const AmplifierParams& coil, const Heating& of, std::uint64_t seed = 1) {
  Rng rng(seed, Purpose::test);
  HeatLog log{.file = "heat.csv"};
  double temperature = coil.ambient;
  int line = 1;
  for (double t = 0; t <= 2 * of.seconds; t += of.every) {
    const double current = t < of.seconds ? of.current : 0.1 * of.current;
    const double resistance =
        coil.resistance * (1 + coil.temperature_coefficient * (temperature - 20));
    HeatRow row{.t = t, .current = current, .line = ++line};
    if (of.voltage) row.voltage = current * resistance * (1 + of.noise * rng.normal());
    if (of.probe_noise >= 0) row.temperature = temperature + of.probe_noise * rng.normal();
    log.rows.push_back(row);
    temperature = temperature_later(coil, temperature, current * current, of.every);
  }
  return log;
}

const AmplifierParams truth{
    .resistance = 1.7, .thermal_resistance = 3.1, .thermal_time = 420, .ambient = 24};
/// What is known before: ambient temperature and copper.
const AmplifierParams unknown{.ambient = 24};

TEST(HeatFit, FindsTheCoilThatMadeTheLog) {
  Rng rng(2, Purpose::test);
  for (int k = 0; k < 50; ++k) {
    AmplifierParams coil = truth;
    coil.resistance = std::exp(rng.uniform(-3, 3));
    coil.thermal_resistance = std::exp(rng.uniform(-1, 2));
    coil.thermal_time = std::exp(rng.uniform(3, 7.5));
    // The current that heats by 10 to 80 K in the end.
    const double warming = rng.uniform(10, 80);
    const double hot = coil.resistance * (1 + 0.00393 * (coil.ambient + warming - 20));
    const Heating of{.current = std::sqrt(warming / (coil.thermal_resistance * hot)),
                     .seconds = 2 * coil.thermal_time,
                     .every = coil.thermal_time / 20};
    const HeatFit fit = fit_heat(heat_log(coil, of), unknown);
    EXPECT_NEAR(fit.resistance.value / coil.resistance, 1, 1e-4) << k;
    EXPECT_NEAR(fit.thermal_resistance.value / coil.thermal_resistance, 1, 1e-3) << k;
    EXPECT_NEAR(fit.thermal_time.value / coil.thermal_time, 1, 1e-3) << k;
    EXPECT_LT(fit.rms, 1e-3) << k;
  }
}

// Of 200 noisy logs the truth is within two standard errors in about 95 %.
TEST(HeatFit, ItsStandardErrorsAreThoseOfItsValues) {
  constexpr int logs = 200;
  int within[3]{};
  for (int seed = 0; seed < logs; ++seed) {
    const HeatFit fit =
        fit_heat(heat_log(truth, {.noise = 0.003}, static_cast<std::uint64_t>(seed)), unknown);
    const FittedValue found[]{fit.resistance, fit.thermal_resistance, fit.thermal_time};
    const double true_values[]{truth.resistance, truth.thermal_resistance, truth.thermal_time};
    for (int k = 0; k < 3; ++k)
      within[k] += std::abs(found[k].value - true_values[k]) <= 2 * found[k].error;
    EXPECT_NEAR(fit.thermal_resistance.value, truth.thermal_resistance, 0.3);
  }
  for (const int count : within) {
    EXPECT_GE(count, 0.89 * logs);
    EXPECT_LE(count, 0.995 * logs);
  }
}

TEST(HeatFit, AProbeAloneIsEnoughWhereTheResistanceIsKnown) {
  AmplifierParams known = unknown;
  known.resistance = truth.resistance;
  const HeatFit fit = fit_heat(heat_log(truth, {.voltage = false, .probe_noise = 0.2}), known);
  EXPECT_EQ(fit.resistance.value, truth.resistance);
  EXPECT_EQ(fit.resistance.error, 0);
  EXPECT_NEAR(fit.thermal_resistance.value, truth.thermal_resistance, 0.1);
  EXPECT_NEAR(fit.thermal_time.value, truth.thermal_time, 30);
}

// A fit that is not refused is right, or says how wrong it may be.
TEST(HeatFit, AShortLogIsRefusedOrRight) {
  int refused = 0;
  int right = 0;
  constexpr int logs = 200;
  for (int seed = 0; seed < logs; ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed), Purpose::test);
    const Heating of{.seconds = rng.uniform(20, 400), .every = 5, .noise = rng.uniform(1e-4, 0.01)};
    const HeatLog log = heat_log(truth, of, static_cast<std::uint64_t>(seed));
    try {
      const HeatFit fit = fit_heat(log, unknown);
      right += std::abs(fit.thermal_resistance.value - truth.thermal_resistance) <=
                   3 * fit.thermal_resistance.error &&
               std::abs(fit.thermal_time.value - truth.thermal_time) <= 3 * fit.thermal_time.error;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0.1 * logs);
  EXPECT_GT(right, 0.15 * logs);
  EXPECT_GT(right, 0.95 * (logs - refused)) << right << " of " << logs - refused;
}

TEST(HeatFit, TheTemperatureOfACoilIsThatOfItsResistance) {
  const double cold = 1.7 * (1 + 0.00393 * 4);
  const double hot = 1.7 * (1 + 0.00393 * 50);
  EXPECT_NEAR(temperature_by(cold, cold, unknown), 24, 1e-9);
  EXPECT_NEAR(temperature_by(hot, cold, unknown), 70, 1e-9);
}

TEST(HeatFit, ALogThatDoesNotDetermineItIsRefused) {
  const auto refused = [](const HeatLog& log, const AmplifierParams& coil = unknown) {
    return test::error_of([&] { fit_heat(log, coil); });
  };
  EXPECT_TRUE(test::is_one_line_naming(refused(heat_log(truth, {.current = 0.5, .noise = 1e-4})),
                                       "heat.csv", {"warmed by", "5 K"}));
  EXPECT_TRUE(test::is_one_line_naming(
      refused(heat_log(truth, {.seconds = 60, .every = 5, .noise = 0.001})), "heat.csv",
      {"uncertain by", "10 %"}));
  EXPECT_TRUE(test::is_one_line_naming(refused(heat_log(truth, {.every = 1000})), "heat.csv",
                                       {"readings, at least 6"}));
  HeatLog reversed = heat_log(truth, {});
  *reversed.rows[4].voltage *= -1;
  EXPECT_TRUE(test::is_one_line_naming(refused(reversed), "heat.csv:6", {"same sign"}));
  AmplifierParams constant = unknown;
  constant.temperature_coefficient = 0;
  EXPECT_TRUE(test::is_one_line_naming(refused(heat_log(truth, {}), constant), "heat.csv",
                                       {"temperature_coefficient_per_k"}));
}

TEST(HeatFit, AWarmStartAndSteadyReadingsAreRefused) {
  AmplifierParams warm = truth;
  warm.ambient = 50;  // of the log's begin, where 24 °C are around it
  HeatLog log = heat_log(truth, {});
  double temperature = warm.ambient;
  for (std::size_t k = 0; k < log.rows.size(); ++k) {
    const double current = log.rows[k].current;
    log.rows[k].voltage =
        current * truth.resistance * (1 + truth.temperature_coefficient * (temperature - 20));
    temperature = temperature_later(truth, temperature, current * current, 30);
  }
  EXPECT_TRUE(test::is_one_line_naming(test::error_of([&] { fit_heat(log, unknown); }), "heat.csv",
                                       {"24 °C", "was it cold"}));
  // Ten time constants between two readings show no time constant.
  const HeatLog steady = heat_log(truth, {.seconds = 40000, .every = 9000});
  EXPECT_TRUE(test::names(test::error_of([&] { fit_heat(steady, unknown); }), "heat.csv"));
}

TEST(HeatLog, IsReadAsItIsWritten) {
  const HeatLog log = heat_log(truth, {.every = 300});
  std::string text = std::string(heat_header) + "\n";
  for (const HeatRow& row : log.rows) text += to_csv_row(row);
  const HeatLog read = parse_heat_log(text, "again.csv");
  ASSERT_EQ(read.rows.size(), log.rows.size());
  for (std::size_t k = 0; k < log.rows.size(); ++k) {
    EXPECT_EQ(read.rows[k].t, log.rows[k].t);
    EXPECT_EQ(read.rows[k].current, log.rows[k].current);
    EXPECT_EQ(read.rows[k].voltage, log.rows[k].voltage);
  }
}

TEST(HeatLog, WhatIsWrongInItIsNamedWithItsLine) {
  const auto refused = [](std::string_view text) {
    return test::error_of([&] { parse_heat_log(text, "h.csv"); });
  };
  EXPECT_TRUE(test::names(refused(""), "header"));
  EXPECT_TRUE(test::names(refused("t_s,v_v\n"), "'i_a' is missing"));
  EXPECT_TRUE(test::names(refused("t_s,i_a\n"), "'v_v'"));
  EXPECT_TRUE(test::names(refused("t_s,i_a,v_v\n0,1,1\n1,1\n"), "h.csv:3: 2 fields"));
  EXPECT_TRUE(test::names(refused("t_s,i_a,v_v\n5,1,1\n4,1,1\n"), "h.csv:3: t_s is 4, earlier"));
  EXPECT_TRUE(test::names(refused("t_s,i_a,v_v\n0,,1\n"), "h.csv:2: "));
  EXPECT_TRUE(test::names(refused("t_s,i_a,v_v\n0,1,much\n"), "h.csv:2: "));
  EXPECT_TRUE(test::names(refused("t_s,i_a,v_v\n0,1,1\n"), "at least two rows"));
  EXPECT_EQ(parse_heat_log("t_s;i_a;v_v\n0;1,5;2\n1;1,5;\n", "h").rows[0].current, 1.5);
}

}  // namespace
}  // namespace microswarm::actuation
