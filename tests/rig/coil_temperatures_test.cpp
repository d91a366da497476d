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
  keep(never, false, "[50, 60]");
  EXPECT_TRUE(test::is_one_line_naming(refused(), file().string(), {"2", "3", "coils_cold"}));
  expect_near(at_start(true), {22, 30, 22});
  expect_near(at_start(), {22, 30, 22});
}

}  // namespace
}  // namespace microswarm::rig
