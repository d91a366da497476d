// SPDX-License-Identifier: Apache-2.0
// The host's driver against the device's program: firmware/coil_driver in a simulated ATmega2560
// (mega_simulator.cpp). How soon the outputs are at zero is told by the device's own time, so a
// busy computer is only waited for.
#include <set>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "tests/firmware/simulator.hpp"

namespace microswarm {
namespace {

using namespace std::chrono_literals;
using namespace test;

class Firmware : public testing::Test {
 protected:
  /// Drives until the outputs are there. A host that was kept from driving in between finds the
  /// device off and begins again.
  bool reaches(actuation::SerialCoilDriver& driver, const Outputs& outputs = some_outputs) {
    for (const auto began = std::chrono::steady_clock::now();
         std::chrono::steady_clock::now() < began + patience; std::this_thread::sleep_for(20ms)) {
      drives(driver);
      if (mega.outputs() == outputs) return true;
    }
    return false;
  }
  static bool drives(actuation::SerialCoilDriver& driver) {
    const auto status = driver.drive(some);
    return status == actuation::DriveStatus::driven || status == actuation::DriveStatus::resumed;
  }

  Simulator mega;
};

TEST_F(Firmware, DrivesAndStops) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::driven);
  EXPECT_TRUE(reaches(driver));
  EXPECT_TRUE(driver.stop().confirmed);
  EXPECT_TRUE(mega.when(off));
}

TEST_F(Firmware, TellsItsStatus) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  std::optional<actuation::CoilReply> status;
  for (int k = 0; k < 100 && !(status && status->state == actuation::CoilState::armed); ++k) {
    ASSERT_TRUE(reaches(driver));
    status = driver.ask_status();
    ASSERT_TRUE(status);
  }
  EXPECT_EQ(status->state, actuation::CoilState::armed);
  EXPECT_EQ(status->outputs, some_outputs);
  EXPECT_EQ(status->bad, 0);
}

TEST_F(Firmware, WaitsUnarmedForTheFirstCurrents) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  std::this_thread::sleep_for(300ms);  // longer than its watchdog
  EXPECT_EQ(driver.ask_status()->trips, 0);
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::driven);
  EXPECT_TRUE(mega.when(some_outputs));
  EXPECT_TRUE(driver.stop().confirmed);
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::driven);
}

TEST_F(Firmware, APortHasOneProgram) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  EXPECT_TRUE(drives(driver));
  try {
    actuation::SerialCoilDriver other(params(mega.port()));
    FAIL();
  } catch (const HardwareError& e) {
    EXPECT_EQ(std::string(e.what()), mega.port() + ": another program drives coils there");
  }
  EXPECT_TRUE(drives(driver));
}

TEST_F(Firmware, ReversesThroughZeroStepByStep) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  const std::array<double, 6> one{20, 0, 0, 0, 0, 0}, other{-20, 0, 0, 0, 0, 0};
  driver.drive(one);
  ASSERT_TRUE(mega.when({1000, 0, 0, 0, 0, 0}));
  driver.drive(other);
  EXPECT_TRUE(mega.when({-1000, 0, 0, 0, 0, 0}));
}

TEST_F(Firmware, RefusesMoreThanTheScale) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  driver.drive(some);
  ASSERT_TRUE(mega.when(some_outputs));
  std::array<double, 6> much = some;
  much[2] = 20.1;
  EXPECT_EQ(driver.drive(much), actuation::DriveStatus::refused);
  much[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(driver.drive(much), actuation::DriveStatus::refused);
}

TEST_F(Firmware, CutCableTurnsOffAndTheDriverSaysSo) {
  auto hasty = params(mega.port());
  hasty.attempts = 3;
  actuation::SerialCoilDriver driver(hasty);
  ASSERT_TRUE(reaches(driver));
  const double cut = mega.order("cut");
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::no_answer);
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - cut, zero_within_ms);
  EXPECT_FALSE(driver.stop().confirmed);
  mega.order("join");
  EXPECT_TRUE(reaches(driver));
  EXPECT_GE(driver.ask_status()->trips, 1);
}

TEST_F(Firmware, SilenceTurnsOff) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  ASSERT_TRUE(reaches(driver));
  const double last = mega.order("mark");
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - last, zero_within_ms);
  EXPECT_EQ(driver.ask_status()->state, actuation::CoilState::tripped);
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::resumed);
}

TEST_F(Firmware, KilledHostTurnsOff) {
  const std::string port = mega.port();
  const pid_t host = fork();
  if (host == 0) {
    try {
      actuation::SerialCoilDriver driver(params(port));
      for (;; std::this_thread::sleep_for(20ms)) driver.drive(some);
    } catch (const HardwareError&) {
      _exit(1);
    }
  }
  ASSERT_TRUE(mega.when(some_outputs));
  kill(host, SIGKILL);
  waitpid(host, nullptr, 0);
  const double killed = mega.order("mark");
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - killed, zero_within_ms);
  actuation::SerialCoilDriver next(params(port));  // drops a half-sent answer
  EXPECT_TRUE(drives(next));
}

TEST_F(Firmware, RestartedDeviceIsOffUntilItIsArmedAgain) {
  actuation::SerialCoilDriver driver(params(mega.port()));
  ASSERT_TRUE(reaches(driver));
  const double restarted = mega.order("reset");
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - restarted, zero_within_ms);
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::resumed);
  EXPECT_TRUE(reaches(driver));
}

// A stock Mega: its bootloader listens first, and a byte keeps it listening for five seconds more.
class StockMega : public testing::Test {
 protected:
  void SetUp() override {
    if (access(BOOTLOADER, R_OK) != 0) GTEST_SKIP() << "no bootloader: install arduino-core-avr";
    mega.emplace(BOOTLOADER);
  }
  std::optional<Simulator> mega;
};

TEST_F(StockMega, IsNotSpokenToUntilItsBootloaderHasEnded) {
  actuation::SerialCoilDriver driver(params(mega->port()));
  EXPECT_EQ(driver.drive(some), actuation::DriveStatus::driven);
  EXPECT_TRUE(mega->when(some_outputs));
}

TEST_F(StockMega, IsLeftAloneWhenItIsResetInARun) {
  auto hasty = params(mega->port());
  hasty.attempts = 3;
  actuation::SerialCoilDriver driver(hasty);
  ASSERT_EQ(driver.drive(some), actuation::DriveStatus::driven);
  mega->order("reset");
  std::set<actuation::DriveStatus> seen;
  for (const auto began = std::chrono::steady_clock::now();
       !seen.count(actuation::DriveStatus::resumed) &&
       std::chrono::steady_clock::now() < began + patience;
       std::this_thread::sleep_for(20ms))
    seen.insert(driver.drive(some));
  EXPECT_EQ(seen, (std::set{actuation::DriveStatus::no_answer, actuation::DriveStatus::resumed}));
  EXPECT_TRUE(mega->when(some_outputs));
}

// A frame that is wrong is never obeyed: outputs are ever only what was sent.
TEST_F(Firmware, LostAndFlippedBytesAreNotObeyed) {
  auto often = params(mega.port());
  often.reply_timeout = 0.02;
  actuation::SerialCoilDriver driver(often);
  mega.order("flip 0.02");
  mega.order("lose 0.01");
  int driven = 0;
  for (const auto began = std::chrono::steady_clock::now();
       driven < 50 && std::chrono::steady_clock::now() < began + patience;) {
    driven += drives(driver);
    const auto now = mega.outputs();
    for (std::size_t c = 0; c < now.size(); ++c) {
      EXPECT_LE(std::abs(now[c]), std::abs(some_outputs[c]));
      EXPECT_GE(now[c] * some_outputs[c], 0);
    }
  }
  EXPECT_EQ(driven, 50);
  mega.order("flip 0");
  mega.order("lose 0");
  const auto status = driver.ask_status();
  ASSERT_TRUE(status);
  EXPECT_GT(status->bad, 0);
}

TEST_F(Firmware, GarbageAloneMovesNothingAndDoesNotKeepItOn) {
  const std::string port = mega.port();
  {
    actuation::SerialCoilDriver driver(params(port));
    ASSERT_TRUE(reaches(driver));
    const int line = open(port.c_str(), O_WRONLY | O_NOCTTY);
    ASSERT_GE(line, 0);
    Rng rng(7, Purpose::test);
    const double began = mega.order("mark");
    for (int k = 0; k < 300; ++k) {
      std::array<std::uint8_t, 8> bytes{};
      for (auto& b : bytes) b = static_cast<std::uint8_t>(rng.below(256));
      ASSERT_EQ(write(line, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
      std::this_thread::sleep_for(1ms);
    }
    close(line);
    const auto zero = mega.when(off);
    ASSERT_TRUE(zero);
    EXPECT_LE(*zero - began, zero_within_ms);
  }
  actuation::SerialCoilDriver again(params(port));
  EXPECT_TRUE(drives(again));
}

TEST(SerialCoilDriver, SaysWhatIsNotThere) {
  actuation::SerialCoilParams p = params("/dev/there-is-no-such-port");
  EXPECT_THROW(actuation::SerialCoilDriver{p}, HardwareError);
  p.port = "/dev/null";
  EXPECT_THROW(actuation::SerialCoilDriver{p}, HardwareError);
  Simulator mute;
  p.port = mute.port();
  mute.order("cut");
  p.attempts = 3;
  p.connect_timeout = 0.5;
  try {
    actuation::SerialCoilDriver driver(p);
    FAIL();
  } catch (const HardwareError& e) {
    EXPECT_TRUE(std::string(e.what()).starts_with(p.port + ": no answer within 0.5 s")) << e.what();
  }
}

}  // namespace
}  // namespace microswarm
