// SPDX-License-Identifier: Apache-2.0
// The host's driver against the device's program, in real time: firmware/coil_driver in a
// simulated ATmega2560 (mega_simulator.cpp).
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "microswarm/actuation/serial_coil_driver.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/core/rng.hpp"

namespace microswarm {
namespace {

using Outputs = std::array<int, 6>;
using namespace std::chrono_literals;

constexpr double full_scale = 20;
constexpr int zero_within_ms = 150;
const std::array<double, 6> some{2, -4, 6, -8, 10, -20};
const Outputs some_outputs{100, -200, 300, -400, 500, -1000};

std::int64_t milliseconds() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// The simulator as a child, and what it prints.
class Simulator {
 public:
  Simulator() {
    std::array<int, 2> to{}, from{};
    if (pipe2(to.data(), O_CLOEXEC) != 0 || pipe2(from.data(), O_CLOEXEC) != 0) std::abort();
    child_ = fork();
    if (child_ == 0) {
      dup2(to[0], STDIN_FILENO);
      dup2(from[1], STDOUT_FILENO);
      execl(MEGA_SIMULATOR, MEGA_SIMULATOR, FIRMWARE, nullptr);
      _exit(127);
    }
    close(to[0]);
    close(from[1]);
    orders_ = to[1];
    listener_ = std::thread([this, from] { listen(fdopen(from[0], "r")); });
  }
  ~Simulator() {
    close(orders_);
    waitpid(child_, nullptr, 0);
    listener_.join();
  }
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  std::string port() {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, 10s, [&] { return !port_.empty(); });
    return port_;
  }
  void order(const std::string& line) {
    const std::string text = line + "\n";
    ASSERT_EQ(write(orders_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  Outputs outputs() {
    std::scoped_lock lock(mutex_);
    return outputs_;
  }
  /// When the outputs became these [ms], waiting for it for a second; nothing if they did not.
  std::optional<std::int64_t> when(const Outputs& wanted) {
    std::unique_lock lock(mutex_);
    if (outputs_ == wanted) return changed_;
    wanted_ = wanted;
    matched_.reset();
    news_.wait_for(lock, 1s, [&] { return matched_.has_value(); });
    return matched_;
  }

 private:
  void listen(std::FILE* file) {
    std::array<char, 256> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), file)) {
      std::istringstream words(line.data());
      std::string what;
      words >> what;
      std::scoped_lock lock(mutex_);
      if (what == "port") words >> port_;
      if (what == "out") {
        words >> changed_;
        for (int& o : outputs_) words >> o;
        if (outputs_ == wanted_ && !matched_) matched_ = changed_;  // it may not stay so
      }
      news_.notify_all();
    }
    std::fclose(file);
  }

  pid_t child_ = -1;
  int orders_ = -1;
  std::thread listener_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::string port_;
  std::int64_t changed_ = 0;
  Outputs outputs_{}, wanted_{};
  std::optional<std::int64_t> matched_;  // when they became those wanted
};

SerialCoilParams params(const std::string& port) {
  SerialCoilParams p;
  p.port = port;
  p.full_scale = full_scale;
  p.reply_timeout = 0.1;  // a busy machine simulates late
  return p;
}

/// Keeps driving for a while.
void keep(SerialCoilDriver& driver, std::chrono::milliseconds duration) {
  for (const auto end = std::chrono::steady_clock::now() + duration;
       std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(20ms))
    driver.drive(some);
}

class Firmware : public testing::Test {
 protected:
  Simulator mega;
  const Outputs off{};
};

TEST_F(Firmware, DrivesAndStops) {
  SerialCoilDriver driver(params(mega.port()));
  EXPECT_EQ(driver.drive(some), DriveStatus::driven);
  keep(driver, 100ms);
  EXPECT_EQ(mega.outputs(), some_outputs);
  const auto status = driver.ask_status();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->outputs, some_outputs);
  EXPECT_EQ(status->state, CoilState::armed);
  EXPECT_EQ(status->bad, 0);
  EXPECT_TRUE(driver.stop());
  EXPECT_TRUE(mega.when(off));
}

TEST_F(Firmware, WaitsUnarmedForTheFirstCurrents) {
  SerialCoilDriver driver(params(mega.port()));
  std::this_thread::sleep_for(300ms);  // longer than its watchdog
  EXPECT_EQ(driver.ask_status()->trips, 0);
  EXPECT_EQ(driver.drive(some), DriveStatus::driven);
  EXPECT_TRUE(mega.when(some_outputs));
  EXPECT_TRUE(driver.stop());
  EXPECT_EQ(driver.drive(some), DriveStatus::driven);
}

TEST_F(Firmware, APortHasOneProgram) {
  SerialCoilDriver driver(params(mega.port()));
  EXPECT_EQ(driver.drive(some), DriveStatus::driven);
  try {
    SerialCoilDriver other(params(mega.port()));
    FAIL();
  } catch (const HardwareError& e) {
    EXPECT_EQ(std::string(e.what()), mega.port() + ": another program drives coils there");
  }
  EXPECT_EQ(driver.drive(some), DriveStatus::driven);
}

TEST_F(Firmware, ReversesThroughZeroStepByStep) {
  SerialCoilDriver driver(params(mega.port()));
  const std::array<double, 6> one{20, 0, 0, 0, 0, 0}, other{-20, 0, 0, 0, 0, 0};
  driver.drive(one);
  ASSERT_TRUE(mega.when({1000, 0, 0, 0, 0, 0}));
  driver.drive(other);
  EXPECT_TRUE(mega.when({-1000, 0, 0, 0, 0, 0}));
}

TEST_F(Firmware, RefusesMoreThanTheScale) {
  SerialCoilDriver driver(params(mega.port()));
  driver.drive(some);
  ASSERT_TRUE(mega.when(some_outputs));
  std::array<double, 6> much = some;
  much[2] = 20.1;
  EXPECT_EQ(driver.drive(much), DriveStatus::refused);
  much[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(driver.drive(much), DriveStatus::refused);
}

TEST_F(Firmware, CutCableTurnsOffAndTheDriverSaysSo) {
  SerialCoilDriver driver(params(mega.port()));
  keep(driver, 100ms);
  ASSERT_EQ(mega.outputs(), some_outputs);
  const auto cut = milliseconds();
  mega.order("cut");
  EXPECT_EQ(driver.drive(some), DriveStatus::no_answer);
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - cut, zero_within_ms);
  EXPECT_FALSE(driver.stop());
  mega.order("join");
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(driver.drive(some), DriveStatus::resumed);
  EXPECT_TRUE(mega.when(some_outputs));
  EXPECT_EQ(driver.ask_status()->trips, 1);
}

TEST_F(Firmware, SilenceTurnsOff) {
  SerialCoilDriver driver(params(mega.port()));
  keep(driver, 100ms);
  ASSERT_EQ(mega.outputs(), some_outputs);
  const auto last = milliseconds();
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - last, zero_within_ms);
  EXPECT_EQ(driver.ask_status()->state, CoilState::tripped);
}

TEST_F(Firmware, KilledHostTurnsOff) {
  const std::string port = mega.port();
  const pid_t host = fork();
  if (host == 0) {
    try {
      SerialCoilDriver driver(params(port));
      for (;;) keep(driver, 1s);
    } catch (const HardwareError&) {
      _exit(1);
    }
  }
  ASSERT_TRUE(mega.when(some_outputs));
  kill(host, SIGKILL);
  const auto killed = milliseconds();
  waitpid(host, nullptr, 0);
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - killed, zero_within_ms);
  SerialCoilDriver next(params(port));  // whatever was half said
  EXPECT_EQ(next.drive(some), DriveStatus::driven);
}

TEST_F(Firmware, RestartedDeviceIsOffUntilItIsArmedAgain) {
  SerialCoilDriver driver(params(mega.port()));
  keep(driver, 100ms);
  ASSERT_EQ(mega.outputs(), some_outputs);
  const auto restarted = milliseconds();
  mega.order("reset");
  const auto zero = mega.when(off);
  ASSERT_TRUE(zero);
  EXPECT_LE(*zero - restarted, zero_within_ms);
  EXPECT_EQ(driver.drive(some), DriveStatus::resumed);
  EXPECT_TRUE(mega.when(some_outputs));
}

// A frame that is wrong is never obeyed: outputs are ever only what was sent.
TEST_F(Firmware, LostAndFlippedBytesAreNotObeyed) {
  auto often = params(mega.port());
  often.reply_timeout = 0.02;
  often.attempts = 20;
  SerialCoilDriver driver(often);
  mega.order("flip 0.02");
  mega.order("lose 0.01");
  std::this_thread::sleep_for(20ms);
  int driven = 0;
  for (int k = 0; k < 60; ++k) {
    const auto status = driver.drive(some);
    driven += status == DriveStatus::driven || status == DriveStatus::resumed;
    const auto now = mega.outputs();
    for (std::size_t c = 0; c < now.size(); ++c) {
      EXPECT_LE(std::abs(now[c]), std::abs(some_outputs[c]));
      EXPECT_GE(now[c] * some_outputs[c], 0);
    }
  }
  EXPECT_GT(driven, 50);
  mega.order("flip 0");
  mega.order("lose 0");
  std::this_thread::sleep_for(20ms);
  const auto status = driver.ask_status();
  ASSERT_TRUE(status);
  EXPECT_GT(status->bad, 0);
}

TEST_F(Firmware, GarbageAloneMovesNothingAndDoesNotKeepItOn) {
  const std::string port = mega.port();
  {
    SerialCoilDriver driver(params(port));
    keep(driver, 100ms);
    ASSERT_EQ(mega.outputs(), some_outputs);
    const int line = open(port.c_str(), O_WRONLY | O_NOCTTY);
    ASSERT_GE(line, 0);
    Rng rng(7, Purpose::test);
    const auto began = milliseconds();
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
  SerialCoilDriver again(params(port));
  EXPECT_EQ(again.drive(some), DriveStatus::driven);
}

TEST(SerialCoilDriver, SaysWhatIsNotThere) {
  SerialCoilParams p = params("/dev/there-is-no-such-port");
  EXPECT_THROW(SerialCoilDriver{p}, HardwareError);
  p.port = "/dev/null";
  EXPECT_THROW(SerialCoilDriver{p}, HardwareError);
  Simulator mute;
  p.port = mute.port();
  mute.order("cut");
  std::this_thread::sleep_for(20ms);
  p.connect_timeout = 0.5;
  try {
    SerialCoilDriver driver(p);
    FAIL();
  } catch (const HardwareError& e) {
    EXPECT_EQ(std::string(e.what()), p.port + ": no answer within 0.5 s");
  }
}

}  // namespace
}  // namespace microswarm
