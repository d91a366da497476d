// SPDX-License-Identifier: Apache-2.0
// Temperatures by PT1000 probes at the simulated chip's analog inputs.
#include <fmt/core.h>

#include <cmath>
#include <iterator>
#include <optional>
#include <string>

#include "tests/firmware/raw_line.hpp"
#include "tests/firmware/simulator.hpp"
#include "tests/firmware/turning_field.hpp"

namespace microswarm {
namespace {

using namespace std::chrono_literals;
using namespace test;

constexpr double broken = 1e9, shorted = 0.1;  // [Ω]
constexpr double step = 1.3;                   // [K] of a reading, at 100 °C

/// A PT1000 by IEC 60751, from 0 °C on [Ω].
double pt1000(double degc) { return 1000 * (1 + 3.9083e-3 * degc - 5.775e-7 * degc * degc); }

/// Sets the probe of a channel; the readings alternate between two resistances.
void set_probe(Simulator& mega, int channel, double ohms, std::optional<double> other = {}) {
  mega.order(fmt::format("probe {} {} {}", channel, ohms, other.value_or(ohms)));
}

/// What the device says of all channels' probes [0.1 °C], or marks.
actuation::CoilOutputs probes_of(RawLine& line) {
  actuation::CoilOutputs probes{};
  for (std::size_t k = 0; k < probes.size(); ++k) {
    const actuation::CoilReply reply = line.status();
    probes[reply.probe] = reply.temperature;
  }
  return probes;
}

/// The same, when the means hold no reading from before.
actuation::CoilOutputs settled(RawLine& line) {
  std::this_thread::sleep_for(900ms);
  return probes_of(line);
}

class FirmwareProbes : public testing::Test {
 protected:
  Simulator mega{nullptr, PROBED_FIRMWARE};  // PROBES=1,1,1,1,1,0
};

TEST_F(FirmwareProbes, ShowWhatAPt1000Has) {
  RawLine line(mega.port());
  for (const double first : {0.0, 20.0, 55.0, 100.0, 180.0}) {
    for (int c = 0; c < 5; ++c) set_probe(mega, c, pt1000(first + 7 * c));
    const actuation::CoilOutputs probes = settled(line);
    for (std::size_t c = 0; c < 5; ++c)
      EXPECT_NEAR(0.1 * probes[c], first + 7 * static_cast<double>(c), step) << c;
    EXPECT_EQ(probes[5], actuation::coil_link_no_probe);
  }
}

TEST_F(FirmwareProbes, TellAnOpenAndAShortedProbe) {
  RawLine line(mega.port());
  EXPECT_EQ(probes_of(line)[0], actuation::coil_link_probe_open);  // known from the start
  set_probe(mega, 1, shorted);
  set_probe(mega, 2, pt1000(-49));
  set_probe(mega, 3, pt1000(248));
  const actuation::CoilOutputs probes = settled(line);
  EXPECT_EQ(probes[0], actuation::coil_link_probe_open);
  EXPECT_EQ(probes[1], actuation::coil_link_probe_shorted);
  EXPECT_NEAR(probes[2], -490, 15);
  EXPECT_NEAR(probes[3], 2480, 40);
  line.arm();
  EXPECT_EQ(line.set(some_outputs).result, actuation::CoilResult::ok);  // no limit is built in
}

// A mean of readings of 20 and 60 °C lies in between, and within one of their steps.
TEST_F(FirmwareProbes, AreMeansOfManyReadings) {
  RawLine line(mega.port());
  set_probe(mega, 0, pt1000(20), pt1000(60));
  EXPECT_NEAR(0.1 * settled(line)[0], 40, 1.5);
}

// The resistors are fed by what the converter compares with.
TEST_F(FirmwareProbes, DoNotDependOnTheSupply) {
  RawLine line(mega.port());
  set_probe(mega, 0, pt1000(60));
  mega.order("supply 4.6");
  EXPECT_NEAR(0.1 * settled(line)[0], 60, step);
}

TEST_F(FirmwareProbes, DoNotHoldUpAWaveform) { expect_waveform(mega); }

TEST_F(FirmwareProbes, ReachTheDriversReport) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  for (int c = 0; c < 4; ++c) set_probe(mega, c, pt1000(30 + 10 * c));
  std::this_thread::sleep_for(900ms);
  for (int k = 0; k < 6; ++k) ASSERT_TRUE(driver.ask_status());
  const actuation::DeviceReport& report = driver.report();
  ASSERT_EQ(report.temperatures.size(), 6u);
  for (std::size_t c = 0; c < 4; ++c)
    EXPECT_NEAR(report.temperatures[c], 30 + 10 * static_cast<double>(c), step);
  EXPECT_TRUE(std::isnan(report.temperatures[4]));
  EXPECT_TRUE(std::isnan(report.temperatures[5]));
  EXPECT_EQ(report.probe_trouble, "the probe of channel 5 is open");
}

TEST(FirmwareWithoutProbes, ShowsNone) {
  Simulator mega;
  actuation::SerialCoilDriver driver(params(mega.port()));
  for (int k = 0; k < 6; ++k) ASSERT_TRUE(driver.ask_status());
  EXPECT_TRUE(driver.report().temperatures.empty());
  EXPECT_EQ(driver.report().probe_trouble, "");
}

/// Firmware with PROBES=1,1,1,0,0,0 MAX_DEGC=90, and probes at 25 °C.
class FirmwareMaxTemperature : public testing::Test {
 protected:
  FirmwareMaxTemperature() {
    for (int c = 0; c < 3; ++c) set_probe(mega, c, pt1000(25));
  }
  /// Drives until the device does otherwise; the last status.
  static actuation::DriveStatus drive_on(actuation::SerialCoilDriver& driver) {
    const auto began = std::chrono::steady_clock::now();
    auto status = actuation::DriveStatus::driven;
    while (
        (status == actuation::DriveStatus::driven || status == actuation::DriveStatus::resumed) &&
        std::chrono::steady_clock::now() < began + patience) {
      status = driver.drive(some);
      std::this_thread::sleep_for(10ms);
    }
    return status;
  }

  Simulator mega{nullptr, GUARDED_FIRMWARE};
};

TEST_F(FirmwareMaxTemperature, TurnsOffAndSaysWhichCoilIsHot) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  ASSERT_EQ(driver.drive(some), actuation::DriveStatus::driven);
  ASSERT_TRUE(mega.when(some_outputs));
  const double at = mega.order(fmt::format("probe 1 {0} {0}", pt1000(94)));
  EXPECT_EQ(drive_on(driver), actuation::DriveStatus::not_armed);
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - at, 500);  // two means of 64 ms for each of three probes
  EXPECT_EQ(driver.ask_status()->trip, actuation::CoilTrip::hot);
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::not_armed);
  const std::string why = trouble_text(driver, actuation::DriveStatus::not_armed);
  EXPECT_TRUE(why.find("the probe of channel 2 shows 9") != std::string::npos) << why;
  std::printf("%s, %.0f ms\n", why.c_str(), *zero - at);
}

TEST_F(FirmwareMaxTemperature, IsArmedAgainWhenItIsFiveDegreesCooler) {
  RawLine line(mega.port());
  set_probe(mega, 2, pt1000(95));
  settled(line);
  EXPECT_EQ(line.last.state, actuation::CoilState::tripped);
  EXPECT_EQ(line.arm().result, actuation::CoilResult::not_armed);
  set_probe(mega, 2, pt1000(88));
  settled(line);
  EXPECT_EQ(line.arm().result, actuation::CoilResult::not_armed);
  set_probe(mega, 2, pt1000(80));
  settled(line);
  EXPECT_EQ(line.arm().result, actuation::CoilResult::ok);
}

TEST_F(FirmwareMaxTemperature, TurnsOffWhenAProbeBreaks) {
  for (const double fault : {broken, shorted}) {
    for (int c = 0; c < 3; ++c) set_probe(mega, c, pt1000(25));
    actuation::SerialCoilDriver driver(params(mega.port()));
    ASSERT_EQ(driver.drive(some), actuation::DriveStatus::driven);
    set_probe(mega, 0, fault);
    EXPECT_EQ(drive_on(driver), actuation::DriveStatus::not_armed);
    EXPECT_TRUE(mega.when(off));
    EXPECT_EQ(trouble_text(driver, actuation::DriveStatus::not_armed),
              std::string("the coils' device is off and does not let itself be armed: the probe of "
                          "channel 1 is ") +
                  (fault == broken ? "open" : "shorted"));
    EXPECT_TRUE(driver.stop().confirmed);
  }
}

TEST_F(FirmwareMaxTemperature, IsKnownBeforeTheFirstArm) {
  set_probe(mega, 1, pt1000(120));
  RawLine line(mega.port());
  EXPECT_EQ(line.arm().result, actuation::CoilResult::not_armed);
  EXPECT_EQ(line.last.trip, actuation::CoilTrip::hot);
}

}  // namespace
}  // namespace microswarm
