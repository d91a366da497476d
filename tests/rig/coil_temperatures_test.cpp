// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/coil_temperatures.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "tests/messages.hpp"
#include "tests/rig/coil_rig.hpp"

namespace microswarm::rig {
namespace {

/// A user's state folder, and a rig whose coils cool with a time constant of five minutes.
class CoilTemperaturesTest : public testing::Test {
 protected:
  CoilTemperaturesTest() { ::setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1); }
  ~CoilTemperaturesTest() override { ::unsetenv("XDG_STATE_HOME"); }

  /// The only file there.
  std::filesystem::path file() const {
    return *std::filesystem::directory_iterator(folder / "state/microswarm");
  }
  void keep(double clock, bool driven, const std::string& temperatures) const {
    write_file_atomically(file(), "coils: any\nclock_s: " + std::to_string(clock) +
                                      "\ndriven: " + (driven ? "true" : "false") +
                                      "\ntemperatures_degc: " + temperatures + "\n");
  }
  Eigen::VectorXd at_start(bool cold = false) const {
    return CoilTemperatures(rig, cold).at_start();
  }
  /// Temperatures of 50, 60 and 70 °C, kept by a program that ends at once.
  void heat(bool confirmed = true) const {
    CoilTemperatures driven(rig, false);
    driven.take(Eigen::Vector3d(50, 60, 70));
    driven.take(actuation::StopReport{.confirmed = confirmed});
  }
  static void expect_near(const Eigen::VectorXd& found, const Eigen::Vector3d& expected,
                          double cooler = 1e-6) {
    ASSERT_EQ(found.size(), 3);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(found[i], expected[i] + 1e-6) << i;
      EXPECT_GT(found[i], expected[i] - cooler) << i;
    }
  }

  static constexpr double never = 4e9;  // [s], a clock after all clocks: nothing has cooled since
  test::Folder folder;
  Rig rig = test::coil_rig(
      folder,
      "[{max_temperature_degc: 80, max_current_a: 5, thermal_resistance_k_per_w: 10},"
      " {max_temperature_degc: 90, max_current_a: 5, thermal_resistance_k_per_w: 10, ambient_degc: "
      "30},"
      " {max_current_a: 5, thermal_resistance_k_per_w: 10}]");
};

TEST_F(CoilTemperaturesTest, OfCoilsThatAreNotKnownAreTheirLimits) {
  const CoilTemperatures unknown(rig, false);
  EXPECT_FALSE(unknown.known());
  expect_near(unknown.at_start(), {80, 90, 22});
  EXPECT_TRUE(test::names(unknown.why_hot(), "coils_cold")) << unknown.why_hot();
  EXPECT_TRUE(test::names(unknown.why_hot(), file().string())) << unknown.why_hot();
}

TEST_F(CoilTemperaturesTest, OutliveTheProgram) {
  expect_near(at_start(true), {22, 30, 22});
  {
    CoilTemperatures driven(rig, false);
    EXPECT_TRUE(driven.known());
    driven.take(Eigen::Vector3d(50, 60, 70));
    driven.take(actuation::StopReport{.confirmed = true});
  }
  expect_near(at_start(), {50, 60, 70}, 5);
}

TEST_F(CoilTemperaturesTest, OfAKilledProgramAreThoseAfterItsLargestCurrents) {
  at_start(true);
  keep(never, true, "[50, 60, 70]");
  const Eigen::VectorXd found = at_start();
  const Eigen::VectorXd expected =
      actuation::heated(rig.system.amplifiers(), Eigen::Vector3d(50, 60, 70), 2);
  expect_near(found, expected);
  keep(never, false, "[50, 60, 70]");
  expect_near(at_start(), {50, 60, 70});
  for (int i = 0; i < 3; ++i) EXPECT_GT(expected[i], 50.05 + 10 * i) << i;
}

TEST_F(CoilTemperaturesTest, FallToTheAmbientOneAndNoLower) {
  at_start(true);
  keep(0, false, "[50, 60, 70]");
  expect_near(at_start(), {22, 30, 22});
  keep(never, false, "[-100, 10, 21]");
  expect_near(at_start(), {22, 30, 22});
}

TEST_F(CoilTemperaturesTest, OfADamagedFileAreRefusedInALineThatSaysWhatHelps) {
  at_start(true);
  const auto refused = [&] { return test::error_of([&] { at_start(); }); };
  write_file_atomically(file(), "temperatures: hot\n");
  EXPECT_TRUE(test::is_one_line_naming(refused(), file().string(), {"coils_cold"}));
  expect_near(at_start(true), {22, 30, 22});
  expect_near(at_start(), {22, 30, 22});
}

TEST_F(CoilTemperaturesTest, OfAnotherNumberOfCoilsAreRefusedColdOrNot) {
  at_start(true);
  keep(never, false, "[50, 60]");
  for (const bool cold : {false, true}) {
    const std::string refused = test::error_of([&] { at_start(cold); });
    EXPECT_TRUE(test::is_one_line_naming(refused, file().string(), {"2 temperatures", "3 coils"}));
  }
}

TEST_F(CoilTemperaturesTest, CoilsAreDrivenUntilTheirZeroIsConfirmed) {
  at_start(true);
  heat();
  EXPECT_TRUE(test::names(read_file(file()), "driven: false"));
  heat(false);
  EXPECT_TRUE(test::names(read_file(file()), "driven: true"));
  at_start();  // a program that drives nothing ends
  EXPECT_TRUE(test::names(read_file(file()), "driven: false"));
}

TEST_F(CoilTemperaturesTest, ColdIsRefusedOfCoilsThatAreKnownToBeWarmer) {
  expect_near(at_start(true), {22, 30, 22});
  heat();
  const std::string refusal = test::error_of([&] { at_start(true); });
  EXPECT_TRUE(test::is_one_line_naming(refusal, "coils_cold", {file().string(), "70"})) << refusal;
  expect_near(at_start(), {50, 60, 70}, 5);  // and nothing is forgotten
  std::filesystem::remove(file());
  expect_near(at_start(true), {22, 30, 22});
}

TEST_F(CoilTemperaturesTest, ColdIsNotBelievedOfAFileThatCannotBeRead) {
  at_start(true);
  constexpr std::uintmax_t too_large = 1 << 30;
  std::filesystem::resize_file(file(), too_large);
  EXPECT_TRUE(test::names(test::error_of([&] { at_start(true); }), file().string()));
  EXPECT_EQ(std::filesystem::file_size(file()), too_large);
}

TEST_F(CoilTemperaturesTest, ColdIsRefusedWhereAKilledProgramDroveFromAnAssumedHeat) {
  at_start();
  const auto kept = [&](bool driven) {
    keep(never, driven, "[80, 90, 22]\nassumed: true");
    return test::error_of([&] { at_start(true); });
  };
  EXPECT_TRUE(test::names(kept(true), "coils_cold"));
  EXPECT_EQ(kept(false), "nothing was thrown");
}

TEST_F(CoilTemperaturesTest, HaveAFileWhateverTheIdentity) {
  for (const std::string& id :
       {std::string(300, 'a'), std::string("../../x"), std::string("a\tb")}) {
    folder.with("odd-coils.yaml", "id: \"" + id + "\"\ncoils: {type: helmholtz}\n");
    const Rig odd = read_rig(folder.with("odd.yaml", "coils: odd-coils.yaml\n"));
    EXPECT_FALSE(CoilTemperatures(odd, false).known());
    CoilTemperatures(odd, true);
    EXPECT_TRUE(CoilTemperatures(odd, false).known());
  }
}

TEST_F(CoilTemperaturesTest, ColdIsBelievedWhereTheHeatWasAssumed) {
  expect_near(at_start(), {80, 90, 22});
  EXPECT_FALSE(CoilTemperatures(rig, false).known());
  expect_near(at_start(), {80, 90, 22}, 5);  // still assumed, and written
  expect_near(at_start(true), {22, 30, 22});
}

TEST_F(CoilTemperaturesTest, ColdIsRefusedOfCoilsThatWereDrivenFromAnAssumedHeat) {
  {
    CoilTemperatures driven(rig, false);
    driven.take(driven.at_start() + Eigen::Vector3d(-20, -20, 9));
  }
  EXPECT_TRUE(test::names(test::error_of([&] { at_start(true); }), "coils_cold"));
}

// A calibration writes another file of the same coils.
TEST_F(CoilTemperaturesTest, AreThoseOfTheCoilsNotOfTheirFile) {
  const std::string kind = "coils: {type: helmholtz}\ndrives: [{max_temperature_degc: 80}]\n";
  const auto rig_of = [&](const std::string& name, const std::string& id) {
    folder.with(name + "-coils.yaml", id + kind);
    return read_rig(folder.with(name + ".yaml", "coils: " + name + "-coils.yaml\n"));
  };
  const Rig first = rig_of("first", "");
  {
    CoilTemperatures driven(first, true);
    driven.take(Eigen::Vector3d(50, 60, 70));
    driven.take(actuation::StopReport{.confirmed = true});
  }
  const Rig calibrated = rig_of("calibrated", "id: '" + coil_identity(first) + "'\n");
  expect_near(CoilTemperatures(calibrated, false).at_start(), {50, 60, 70}, 5);
  EXPECT_FALSE(CoilTemperatures(rig_of("other", "id: lab 2\n"), false).known());
  CoilTemperatures(rig_of("other", "id: lab 2\n"), true);
  EXPECT_TRUE(CoilTemperatures(rig_of("copy", "id: lab 2\n"), false).known());
}

TEST_F(CoilTemperaturesTest, AClockThatIsSetForwardsCoolsNothing) {
  at_start(true);
  heat();
  ClockReading tomorrow = read_clocks();
  tomorrow.wall += 86400;
  expect_near(CoilTemperatures(rig, false, tomorrow).at_start(), {50, 60, 70}, 5);
}

TEST(ClockReading, OnlyWhatHasPassedForCertainIsAPause) {
  constexpr double y2026 = 1.78e9;
  struct Case {
    const char* what;
    ClockReading then, now;
    double pause;
  };
  const Case cases[] = {
      {"plain", {y2026, 100, "a"}, {y2026 + 60, 160, "a"}, 60},
      {"suspended", {y2026, 100, "a"}, {y2026 + 3600, 3700, "a"}, 3600},
      {"set forwards", {y2026, 100, "a"}, {y2026 + 86400, 120, "a"}, 20},
      {"set back", {y2026, 100, "a"}, {y2026 - 3600, 160, "a"}, 0},
      {"restarted", {y2026, 5000, "a", true}, {y2026 + 7200, 30, "b", true}, 7200},
      {"restarted and set back", {y2026, 5000, "a", true}, {y2026 - 7200, 30, "b", true}, 30},
      {"restarted, set by nobody then", {y2026, 5000, "a"}, {y2026 + 9e4, 30, "b", true}, 30},
      {"restarted, set by nobody now", {y2026, 5000, "a", true}, {y2026 + 9e4, 30, "b"}, 30},
      {"of a former version", {y2026, 0, ""}, {y2026 + 60, 160, "a"}, 60},
      {"of a former version, set back", {y2026, 0, ""}, {y2026 - 60, 160, "a"}, 0},
  };
  for (const Case& c : cases) EXPECT_NEAR(certain_pause(c.then, c.now), c.pause, 1e-6) << c.what;
}

TEST(ClockReading, NamesTheStartOfThisComputer) {
  const ClockReading a = read_clocks(), b = read_clocks();
  EXPECT_EQ(a.boot, b.boot);
  EXPECT_FALSE(a.boot.empty());
  EXPECT_GT(a.uptime, 0);
  EXPECT_LE(a.uptime, b.uptime);
  EXPECT_LT(certain_pause(a, b), 60);
}

}  // namespace
}  // namespace microswarm::rig
