// SPDX-License-Identifier: Apache-2.0
// What turns the outputs off and what keeps them on, message by message.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "tests/files.hpp"
#include "tests/firmware/raw_line.hpp"
#include "tests/firmware/simulator.hpp"
#include "tests/firmware/turning_field.hpp"

namespace microswarm {
namespace {

using namespace std::chrono_literals;
using namespace test;

class FirmwareSafety : public testing::Test {
 protected:
  /// Armed, and the outputs there. A computer that is busy may need several attempts.
  void drive(RawLine& line) {
    for (const auto began = std::chrono::steady_clock::now();
         mega.outputs() != some_outputs && std::chrono::steady_clock::now() < began + patience;
         std::this_thread::sleep_for(5ms))
      if (line.set(some_outputs).result == actuation::CoilResult::not_armed) line.arm();
    ASSERT_EQ(mega.outputs(), some_outputs);
  }

  Simulator mega;
};

// Of what a host says without setting outputs, nothing keeps them on.
TEST_F(FirmwareSafety, OnlyAnObeyedSetFeedsTheWatchdog) {
  RawLine line(mega.port());
  for (const int kind : {0, 1, 2, 3}) {
    drive(line);
    const std::uint8_t last_set = line.sequence;
    const double began = mega.order("mark");
    for (int k = 0; k < 30 && line.last.state == actuation::CoilState::armed; ++k) {
      if (kind == 0) line.status();
      if (kind == 1) line.set(some_outputs, -20);  // late
      if (kind == 2)
        line.ask(actuation::encode(actuation::CoilMessage::set, ++line.sequence));  // too short
      if (kind == 3)
        line.ask(actuation::encode_set(last_set, line.last.clock + 1000, some_outputs));
      std::this_thread::sleep_for(10ms);
    }
    const auto zero = mega.when(off);
    ASSERT_TRUE(zero) << kind;
    EXPECT_LE(*zero - began, zero_within_ms) << kind;
    EXPECT_EQ(line.status().trip, actuation::CoilTrip::silence) << kind;
  }
}

TEST_F(FirmwareSafety, ALateSetIsStale) {
  RawLine line(mega.port());
  drive(line);
  EXPECT_EQ(line.set({}, -20).result, actuation::CoilResult::stale);
  EXPECT_NE(mega.outputs(), off);
  EXPECT_EQ(line.set({}, 20).result, actuation::CoilResult::ok);
  EXPECT_TRUE(mega.when(off));
}

TEST_F(FirmwareSafety, AHelloTurnsOff) {
  RawLine line(mega.port());
  drive(line);
  const double began = mega.order("mark");
  EXPECT_EQ(line.hello().state, actuation::CoilState::idle);
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - began, 20);
}

TEST_F(FirmwareSafety, AmplifiersAreEnabledWhileArmed) {
  RawLine line(mega.port());
  EXPECT_FALSE(mega.enabled());
  drive(line);
  EXPECT_TRUE(mega.enabled());
  ASSERT_TRUE(mega.when(off));  // by silence
  mega.order("mark");
  EXPECT_FALSE(mega.enabled());
}

TEST_F(FirmwareSafety, ThePressedEmergencyStopTurnsOffAndRefusesToArm) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  ASSERT_EQ(driver.drive(some), actuation::DriveStatus::driven);
  const double pressed = mega.order("press");
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - pressed, 10);
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::emergency);
  EXPECT_EQ(driver.ask_status()->trip, actuation::CoilTrip::emergency);
  EXPECT_TRUE(driver.ask_status()->emergency_open);
  EXPECT_TRUE(driver.stop().confirmed);
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::emergency);  // does not let itself be armed
  mega.order("release");
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(driver.drive(some),
            actuation::DriveStatus::driven);  // after a stop it may be armed again
}

TEST_F(FirmwareSafety, AReleasedEmergencyStopDoesNotTurnOnByItself) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  ASSERT_EQ(driver.drive(some), actuation::DriveStatus::driven);
  mega.order("press");
  ASSERT_TRUE(mega.when(off));
  mega.order("release");
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::emergency);
  EXPECT_EQ(mega.outputs(), off);
}

TEST_F(FirmwareSafety, TellsWhyItRestarted) {
  RawLine line(mega.port());
  EXPECT_EQ(line.last.reset_cause, 2);  // the port was opened
  mega.order("brownout");
  std::this_thread::sleep_for(200ms);
  line.status();
  EXPECT_EQ(line.status().reset_cause, 4);
}

TEST_F(FirmwareSafety, MakesAWaveformWithoutTheHost) { expect_waveform(mega); }

// The whole way: a heading and a speed become a waveform of the device, whose field keeps turning
// at 100 Hz while the host tells it 50 times a second.
TEST_F(FirmwareSafety, AControllerSteersAFieldThatTheDeviceTurns) {
  const Folder folder;
  actuation::SerialCoilParams serial = params(mega.port());
  serial.waveforms = true;
  actuation::SerialCoilDriver driver(serial);
  const actuation::CoilSystem system = actuation::read_coil_system(
      std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios/rigs/helmholtz.yaml");
  actuation::FieldGeneratorParams field;
  field.frequency = 100;
  field.amplitude = 2;
  actuation::CoilController controller(system, field, driver, 0);
  const auto drive = [&](double seconds, double heading) {
    controller.command(Command{.heading = heading, .speed = 20});
    for (double t = 0; t < seconds; t += 0.02) {
      ASSERT_EQ(controller.advance(0.02).status, actuation::DriveStatus::driven) << t;
      std::this_thread::sleep_for(12ms);
    }
  };
  drive(0.5, 0);
  mega.order("trace " + (folder / "trace").string());
  drive(0.4, 0.5);
  mega.order("trace");
  double before = 0, turned = 0, least = infinity, most = 0;
  const std::vector<Moment> moments = read_trace(folder / "trace");
  ASSERT_GT(moments.size(), 600u);
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const Moment& m = moments[k];
    const double size = std::hypot(m.x, m.y, m.z);
    least = std::min(least, size);
    most = std::max(most, size);
    const double angle = std::atan2(m.y, m.x);
    if (k > 0) turned += std::remainder(angle - before, 2 * pi);
    before = angle;
  }
  const double turns = turned / (2 * pi) / (moments.back().t - moments.front().t);
  std::printf("%.2f Hz, outputs of %.0f to %.0f per mille\n", turns, least, most);
  EXPECT_NEAR(std::abs(turns), 100, 3);
  EXPECT_GT(least, 0.5 * most);  // never a gap
}

TEST(FirmwareLimits, AreThoseGivenToMakeAndKeepTheDirection) {
  Simulator mega(nullptr, LIMITED_FIRMWARE);  // LIMITS=500,1000,1000,1000,1000,800 SLEW=50
  actuation::SerialCoilDriver driver(params(mega.port()));
  const std::array<double, 6> uneven{20, -4, 6, -8, 10, -8};
  EXPECT_EQ(driver.drive(uneven), actuation::DriveStatus::scaled);
  EXPECT_NEAR(driver.report().scale, 0.5, 0.001);
  EXPECT_TRUE(mega.when({500, -100, 150, -200, 250, -200}));
}

/// The firmware's program by `make` with these settings; empty if it is refused.
std::string built_with(const std::string& settings) {
  const Folder out;
  const std::string make =
      "make --silent -C " MICROSWARM_SOURCE_DIR "/firmware/coil_driver OUT=" + (out / "").string() +
      " " + settings + " >/dev/null 2>&1";
  return std::system(make.c_str()) == 0 ? read_file(out / "coil_driver.hex") : std::string();
}

TEST(FirmwareSettings, ThatWouldDriveWithoutALimitAreNotBuilt) {
  for (const char* wrong :
       {"LIMITS=-800,1000,1000,1000,1000,1000", "LIMITS=8000,1000,1000,1000,1000,1000",
        "LIMITS=800", "LIMITS=1,1,1,1,1,1,1", "SLEW=100-99", "EMERGENCY_STOP=None"})
    EXPECT_EQ(built_with(wrong), "") << wrong;
  EXPECT_NE(built_with("LIMITS=0,1000,1000,1000,1000,1000"), "");
}

TEST(FirmwareSettings, AreValuesAsAWhole) {
  const std::string probes = "PROBES=1,1,1,0,0,0 ";
  const std::string plain = built_with(probes + "MAX_DEGC=70 PROBE_OHMS=2200 SLEW=60");
  EXPECT_NE(plain, "");
  EXPECT_EQ(built_with(probes + "MAX_DEGC=80-10 PROBE_OHMS=2000+200 SLEW=50+10"), plain);
}

}  // namespace
}  // namespace microswarm
