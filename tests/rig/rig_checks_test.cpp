// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/rig_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <utility>

#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "tests/messages.hpp"
#include "tests/rig/coil_rig.hpp"

namespace microswarm::rig {
namespace {

constexpr const char* limited =
    "[{max_current_a: 9, max_voltage_v: 40, max_temperature_degc: 90},"
    " {max_current_a: 9, max_voltage_v: 40, max_temperature_degc: 90},"
    " {max_current_a: 9, max_voltage_v: 40, max_temperature_degc: 90}]";

/// Gives these answers and then says that it is enough.
class AnsweringDriver : public actuation::CoilDriver {
 public:
  AnsweringDriver(std::vector<actuation::DriveStatus> answers, bool stops)
      : answers_(answers), stops_(stops) {}
  actuation::Capabilities capabilities() const override { return {.channels = 6}; }
  const actuation::DeviceReport& report() const override { return report_; }
  actuation::DriveStatus drive(const actuation::CoilRequest& request) override {
    const auto currents = std::get<std::span<const double>>(request);
    EXPECT_EQ(currents.size(), 6u);
    EXPECT_TRUE(std::ranges::all_of(currents, [](double i) { return i == 0; }));
    const actuation::DriveStatus answer = answers_[given++];
    report_.reason = answer == actuation::DriveStatus::no_answer ? "out of step" : "";
    if (given == answers_.size()) enough = true;
    return answer;
  }
  actuation::StopReport stop() noexcept override { return {.confirmed = stops_}; }

  std::size_t given = 0;
  std::atomic<bool> enough = false;
  actuation::DeviceReport report_{.currents = std::vector<double>(6)};

 private:
  std::vector<actuation::DriveStatus> answers_;
  bool stops_;
};

class RigChecks : public testing::Test {
 protected:
  struct Driven {
    std::vector<RigCheck> checks;
    std::size_t given = 0;
    /// Whether all checks of that name are good, and there is one.
    bool good(const std::string& what) const {
      const auto is = [&](const RigCheck& check) { return check.what == what; };
      return std::ranges::any_of(checks, is) &&
             std::ranges::all_of(checks, [&](const RigCheck& c) { return c.good || !is(c); });
    }
    /// Whether a run is refused for a check of that name.
    bool refused(const std::string& what) const {
      return std::ranges::any_of(checks, [&](const RigCheck& check) {
        return check.what == what && !check.good && check.required;
      });
    }
    /// All that checks of that name say.
    std::string answer(const std::string& what) const {
      std::string text;
      for (const RigCheck& check : checks)
        if (check.what == what) text += check.answer + "\n";
      return text;
    }
  };
  Driven exchange(std::vector<actuation::DriveStatus> answers, bool stops = true,
                  const std::vector<double>& temperatures = {},
                  const std::string& probe_trouble = "") const {
    AnsweringDriver driver(std::move(answers), stops);
    driver.report_.temperatures = temperatures;
    driver.report_.probe_trouble = probe_trouble;
    Driven out;
    const Rig rig = test::coil_rig(folder, limited, {"drive_rate_hz=10000"});
    out.checks = check_driver(driver, rig, 1e6, Stop(&driver.enough));
    out.given = driver.given;
    return out;
  }

  test::Folder folder;
};

TEST_F(RigChecks, TheComputerSaysByHowMuchItsThreadsAreLate) {
  const RigCheck usual =
      check_computer(test::coil_rig(folder, limited, {"drive_rate_hz=200"}), 0.3);
  EXPECT_TRUE(usual.good) << usual.answer;
  EXPECT_TRUE(test::is_one_line_naming(usual.answer, "", {"p50", "ms"}));
  EXPECT_FALSE(usual.required);
}

TEST_F(RigChecks, TheCoilsHoldTheFieldOrSayHowMuchOfIt) {
  const RigCheck good = check_field(test::coil_rig(folder, limited));
  EXPECT_TRUE(good.good) << good.answer;
  EXPECT_FALSE(test::names(good.answer, "limit")) << good.answer;
  const RigCheck unlimited = check_field(test::coil_rig(folder, "[{}, {}, {}]"));
  EXPECT_TRUE(unlimited.good);
  EXPECT_TRUE(test::is_one_line_naming(unlimited.answer, "", {"voltage", "temperature"}));
  const RigCheck weak =
      check_field(test::coil_rig(folder, "[{max_current_a: 0.01}, {max_current_a: 0.01}, {}]"));
  EXPECT_FALSE(weak.good);
  EXPECT_TRUE(test::is_one_line_naming(weak.answer, "", {"mT"}));
}

TEST_F(RigChecks, AFieldThatTheSwarmCannotFollowIsRefused) {
  Rig rig = test::coil_rig(folder, limited);
  rig.params.field.step_out_frequency = rig.params.field.frequency;
  EXPECT_TRUE(check_field(rig).good);
  rig.params.field.step_out_frequency = 0.99 * rig.params.field.frequency;
  EXPECT_FALSE(check_field(rig).good);
  EXPECT_TRUE(test::is_one_line_naming(check_field(rig).answer, "", {"step_out_frequency_hz"}));
}

// Two seconds from cold say nothing of an hour.
TEST_F(RigChecks, HowLongTheCoilsHoldTheFieldIsTold) {
  const auto held = [&](double thermal_resistance) {
    const std::string drive = fmt::format(
        "{{max_current_a: 10, resistance_ohm: 1, max_temperature_degc: 90, "
        "thermal_time_s: 400, thermal_resistance_k_per_w: {}}}",
        thermal_resistance);
    return check_field(test::coil_rig(folder, fmt::format("[{0}, {0}, {0}]", drive))).answer;
  };
  EXPECT_TRUE(test::names(held(0.01), "indefinitely")) << held(0.01);
  const std::string hot = held(20);
  EXPECT_FALSE(test::names(hot, "indefinitely")) << hot;
  EXPECT_TRUE(test::names(hot, "90 °C")) << hot;
  EXPECT_TRUE(test::names(hot, "coil")) << hot;
}

TEST_F(RigChecks, MissingLimitsAreNamed) {
  EXPECT_TRUE(missing_limits(test::coil_rig(folder, limited)).empty());
  const auto text = [&](const std::string& drive) {
    const Issues issues = missing_limits(test::coil_rig(folder, "[" + drive + ", " + drive +
                                                                    ", {max_current_a: 1, "
                                                                    "max_temperature_degc: 90}]"));
    return issues.empty() ? "" : issues.begin()->text;
  };
  EXPECT_TRUE(test::names(text("{max_current_a: 1}"), "the temperature"));
  EXPECT_FALSE(test::names(text("{max_current_a: 1}"), "the current"));
  EXPECT_TRUE(test::names(text("{max_temperature_degc: 90}"), "the current"));
  EXPECT_FALSE(test::names(text("{max_temperature_degc: 90}"), "the temperature"));
  EXPECT_TRUE(test::names(text("{}"), "the current and the temperature"));
}

using enum actuation::DriveStatus;

TEST_F(RigChecks, ADriverThatAnswersIsGood) {
  const Driven all = exchange({driven, driven, scaled});
  EXPECT_EQ(all.given, 3u) << "until it is told to stop";
  EXPECT_TRUE(all.good("driver"));
  EXPECT_TRUE(all.good("stop"));
  EXPECT_TRUE(test::names(all.answer("driver"), "3")) << all.answer("driver");
}

TEST_F(RigChecks, ProbesAreShownAndABrokenOneIsNamed) {
  EXPECT_EQ(exchange({driven}).answer("probes"), "");
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Driven well = exchange({driven}, true, {21.04, none, 23, none, none, none});
  EXPECT_TRUE(well.good("probes"));
  EXPECT_EQ(well.answer("probes"), "x 21.0 °C, y none, z 23.0 °C\n");
  const Driven broken = exchange({driven}, true, {21, none, 23}, "the probe of channel 2 is open");
  EXPECT_FALSE(broken.good("probes"));
  EXPECT_FALSE(broken.refused("probes"));
  EXPECT_EQ(broken.answer("probes"), "the probe of channel 2 is open\n");
}

// A run ends at the third.
TEST_F(RigChecks, UpToTwoMissedAnswersInARowAreNoted) {
  const Driven some =
      exchange({driven, no_answer, driven, no_answer, no_answer, driven, no_answer, driven});
  EXPECT_EQ(some.given, 8u);
  EXPECT_FALSE(some.good("driver"));
  EXPECT_FALSE(some.refused("driver"));
  EXPECT_TRUE(test::names(some.answer("driver"), "4 without an answer: out of step"))
      << some.answer("driver");
  const Driven lost = exchange({driven, no_answer, no_answer, no_answer, driven});
  EXPECT_EQ(lost.given, 4u);
  EXPECT_TRUE(lost.refused("driver"));
  EXPECT_TRUE(test::names(lost.answer("driver"), "does not answer: out of step"));
}

TEST_F(RigChecks, ADriverThatIsGoneIsAskedNoMore) {
  EXPECT_EQ(exchange({driven, gone, driven}).given, 2u);
  EXPECT_EQ(exchange({no_answer, no_answer, no_answer, driven}).given, 3u);
  for (const actuation::DriveStatus trouble :
       {refused, not_armed, emergency, mismatched, gone, resumed})
    EXPECT_FALSE(exchange({driven, trouble, driven}).good("driver")) << to_string(trouble);
}

TEST_F(RigChecks, AStopThatIsNotConfirmedIsNoGoodOne) {
  EXPECT_FALSE(exchange({driven}, false).good("stop"));
}

TEST_F(RigChecks, QuantilesOfTimesAreRoundedUpByAPercentAtMost) {
  EXPECT_EQ(quantiles({}), "–");
  Durations times;
  for (int i = 0; i <= 100; ++i) times.add(1e-3 * i);
  double median = 0, p95 = 0, p99 = 0;
  ASSERT_EQ(std::sscanf(quantiles(times).c_str(), "%lf / %lf / %lf ms", &median, &p95, &p99), 3);
  for (const auto& [shown, exact] : {std::pair{median, 50.}, {p95, 95.}, {p99, 99.}}) {
    EXPECT_GE(shown, exact - 0.005);
    EXPECT_LE(shown, 1.01 * exact + 0.005);
  }
}

}  // namespace
}  // namespace microswarm::rig
