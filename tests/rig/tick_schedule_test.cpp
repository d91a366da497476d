// SPDX-License-Identifier: Apache-2.0
// When ticks begin, with clocks that are only numbers.
#include "microswarm/rig/runtime/tick_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace microswarm::rig {
namespace {

/// The ticks of a schedule that is driven as a rig drives it.
struct Ticks {
  std::vector<double> begun;  ///< [s]
  std::vector<double> age;    ///< of the newest picture then [s]
  int missed = 0;
};

/// Ticks whose commands take `work` [s], with a camera of another period [s] that begins at `phase`
/// and claims `rate` [Hz].
Ticks run(double tick, double period, double phase, std::optional<double> rate, int count,
          double work = 0) {
  const auto picture_before = [&](double t) { return std::floor((t - phase) / period); };
  TickSchedule schedule(tick, rate);
  Ticks ticks;
  double now = 1, taken = -1;  // number of the last picture that was taken
  for (int k = 0; k < count; ++k) {
    schedule.start(now);
    now = std::max(now, schedule.earliest());
    double newest = picture_before(now);
    if (newest <= taken || phase + newest * period < schedule.earliest()) {
      const double next = phase + (newest + 1) * period;
      now = std::max(now, std::min(next, schedule.latest()));
      newest = picture_before(now + 1e-12);
    }
    const bool is_new = newest > taken;
    taken = newest;
    const double came = phase + newest * period;
    schedule.begin(is_new ? std::optional(came) : std::nullopt);
    ticks.begun.push_back(now);
    ticks.age.push_back(now - came);
    now += work;
    ticks.missed += !schedule.end(now, tick);
  }
  return ticks;
}

double mean_period(const Ticks& ticks) {
  return (ticks.begun.back() - ticks.begun.front()) / static_cast<double>(ticks.begun.size() - 1);
}

TEST(TickSchedule, ATickBeginsWithItsPictureWhateverThePhaseOfTheCamera) {
  for (const double period : {0.01, 0.0099, 0.0101, 0.00999, 0.01001})
    for (const double phase : {0.0, 0.0013, 0.005, 0.0088}) {
      const Ticks ticks = run(0.01, period, phase, 100, 2000, 0.004);
      for (const double age : ticks.age) EXPECT_LT(age, 1e-9) << period << " " << phase;
      EXPECT_NEAR(mean_period(ticks), period, 1e-5) << period << " " << phase;
      EXPECT_EQ(ticks.missed, 0);
    }
}

TEST(TickSchedule, AQuickCameraDoesNotChangeTheMeanRateOfTheTicks) {
  for (const double rate : {30.0, 47.0, 60.0, 64.0, 500.0}) {
    const Ticks ticks = run(0.1, 1 / rate, 0.003, rate, 3000, 0.02);
    for (const double age : ticks.age) EXPECT_LT(age, 1e-9) << rate;
    EXPECT_NEAR(mean_period(ticks), 0.1, 0.002) << rate;
    EXPECT_EQ(ticks.missed, 0) << rate;
  }
}

TEST(TickSchedule, WithASlowOrUnknownCameraATickBeginsWhenItIsDue) {
  for (const std::optional<double> rate : {std::optional(30.0), std::optional<double>()}) {
    const Ticks ticks = run(0.01, 1 / 30.0, 0.003, rate, 100, 0.004);
    for (std::size_t k = 0; k < ticks.begun.size(); ++k)
      EXPECT_NEAR(ticks.begun[k], 1 + 0.01 * static_cast<double>(k), 1e-9);
    EXPECT_EQ(ticks.missed, 0);
  }
}

TEST(TickSchedule, ACameraThatFallsBehindItsRateDelaysATickByHalfAPeriodAtMost) {
  const Ticks ticks = run(0.01, 0.025, 0.003, 100, 400, 0.004);
  EXPECT_NEAR(mean_period(ticks), 0.01, 1e-3);
  for (std::size_t k = 1; k < ticks.begun.size(); ++k)
    EXPECT_LE(ticks.begun[k] - ticks.begun[k - 1], 0.0201);
  EXPECT_EQ(ticks.missed, 0);
}

TEST(TickSchedule, ATickThatTakesLongerThanATickMissesItsDeadline) {
  EXPECT_EQ(run(0.01, 0.01, 0.002, 100, 50, 0.0101).missed, 50);
  EXPECT_EQ(run(0.01, 0.01, 0.002, 100, 50, 0.0099).missed, 0);
  EXPECT_EQ(run(0.01, 0.05, 0.002, {}, 50, 0.0101).missed, 50);
  EXPECT_EQ(run(0.01, 0.05, 0.002, {}, 50, 0.0099).missed, 0);
}

TEST(TickSchedule, AfterAMissedDeadlineTheNextTickIsDueAtOnce) {
  TickSchedule schedule(0.1, std::nullopt);
  schedule.start(1);
  schedule.begin({});
  EXPECT_FALSE(schedule.end(1.35, 0.1));
  EXPECT_EQ(schedule.latest(), 1.35);
  schedule.begin({});
  EXPECT_TRUE(schedule.end(1.36, 0.1));
  EXPECT_NEAR(schedule.latest(), 1.45, 1e-12);
}

}  // namespace
}  // namespace microswarm::rig
