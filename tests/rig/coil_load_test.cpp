// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/coil_load.hpp"

#include <gtest/gtest.h>

#include "microswarm/config/yaml.hpp"
#include "microswarm/rig/runtime/coil_notes.hpp"
#include "tests/messages.hpp"

namespace microswarm::rig {
namespace {

TEST(CoilLoad, IsThatOfTheMostLoadedCoilWithinTheLastSecond) {
  const actuation::CoilSystem system(
      read_yaml_text<actuation::CoilSystemParams>(
          "{coils: {type: helmholtz}, drives: [{max_current_a: 10, max_temperature_degc: 90}, "
          "{max_current_a: 2, max_temperature_degc: 60}, {max_temperature_degc: 200}]}",
          "coils"),
      "coils");
  CoilLoadMeter meter(system);
  actuation::CoilOutput output;
  output.currents = Eigen::Vector3d(-5, 1.6, 0.1);
  output.temperatures = Eigen::Vector3d(40, 35, 100);
  output.scale = 0.7;
  meter.take(100, output);
  EXPECT_NEAR(meter.load().current, 1.6, 1e-12);  // 80 % of its limit
  EXPECT_EQ(meter.load().max_current, 2);
  EXPECT_EQ(meter.load().temperature, 35);
  EXPECT_EQ(meter.load().max_temperature, 60);
  EXPECT_NEAR(meter.load().scale, 0.7, 1e-12);
  output.currents = Eigen::Vector3d(0.1, 0.1, 0.01);
  output.scale = 1;
  meter.take(100.3, output);
  EXPECT_NEAR(meter.load().current, 1.6, 1e-12);
  EXPECT_NEAR(meter.load().scale, 0.7, 1e-12);
  for (double t = 100.4; t < 101.2; t += 0.1) meter.take(t, output);
  EXPECT_NEAR(meter.load().current, 0.1, 1e-12);
  EXPECT_EQ(meter.load().scale, 1);
}

TEST(CoilLoad, WithoutALimitItIsTheLargestCurrent) {
  const actuation::CoilSystem system(
      read_yaml_text<actuation::CoilSystemParams>("coils: {type: helmholtz}", "coils"), "coils");
  CoilLoadMeter meter(system);
  actuation::CoilOutput output;
  output.currents = Eigen::Vector3d(-5, 1.6, 0.1);
  output.temperatures = Eigen::Vector3d(40, 35, 41);
  meter.take(0, output);
  EXPECT_EQ(meter.load().current, 5);
  EXPECT_EQ(meter.load().max_current, std::nullopt);
  EXPECT_EQ(meter.load().temperature, 41);
  EXPECT_EQ(meter.load().max_temperature, std::nullopt);
}

class CoilNotesTest : public testing::Test {
 protected:
  std::vector<std::string> take() { return notes.take(output, system); }

  actuation::CoilSystem system{
      read_yaml_text<actuation::CoilSystemParams>(
          "{coils: {type: helmholtz}, drives: [{max_temperature_degc: 90}]}", "coils"),
      "coils"};
  actuation::CoilOutput output;
  CoilNotes notes;
};

TEST_F(CoilNotesTest, ALooseProbeIsNamedOnceThoughItComesBack) {
  const std::string loose = "the probe of channel 2 is open";
  output.probe_trouble = loose;
  ASSERT_EQ(take().size(), 1u);
  for (int i = 0; i < 100; ++i) {
    output.probe_trouble = i % 2 == 0 ? "" : loose;
    EXPECT_TRUE(take().empty());
  }
  output.probe_trouble = loose + ", the probe of channel 3 is shorted";
  const std::vector<std::string> other = take();
  ASSERT_EQ(other.size(), 1u);
  EXPECT_TRUE(other.front().starts_with("the probe of channel 3 is shorted: ")) << other.front();
}

TEST_F(CoilNotesTest, ACoilThatItsProbeShowsBeyondItsLimitIsNamedOnce) {
  output.temperatures = Eigen::Vector3d(25, 90, 25);
  EXPECT_TRUE(take().empty());
  output.temperatures[1] = 500;
  EXPECT_EQ(take(), std::vector<std::string>{"coil y is at 500 °C by its probe, limit 90 °C"});
  output.temperatures[1] = 510;
  EXPECT_TRUE(take().empty());
}

}  // namespace
}  // namespace microswarm::rig
