// SPDX-License-Identifier: Apache-2.0
// What the driver makes of a device that refuses, is silent, or does something else.
#include "microswarm/actuation/drivers/serial_coil_driver.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "microswarm/core/errors/error.hpp"
#include "tests/actuation/fake_device.hpp"
#include "tests/messages.hpp"

namespace microswarm {
namespace {

const std::array<double, 6> some_amperes{1, -2, 3, -4, 5, -6};

SerialCoilParams params_of(const test::FakeDevice& device) {
  SerialCoilParams p;
  p.port = device.port();
  p.boot_time = 0;
  p.reply_timeout = 0.09;
  p.attempts = 20;
  return p;
}

TEST(SerialCoilDriverPty, ARefusedArmIsNoSilence) {
  test::FakeDevice device([](CoilReply& reply) {
    if (reply.to == CoilMessage::arm || reply.to == CoilMessage::set) {
      reply.result = CoilResult::not_armed;
      reply.state = CoilState::tripped;
    }
    return true;
  });
  SerialCoilDriver driver(params_of(device));
  EXPECT_EQ(driver.drive(some_amperes), DriveStatus::not_armed);
}

TEST(SerialCoilDriverPty, AStopDoesNotWaitForAnswersThatDoNotCome) {
  for (const double reply_timeout : {0.09, 1.0}) {
    std::atomic<bool> mute = false;
    test::FakeDevice device([&](CoilReply&) { return !mute; });
    SerialCoilParams p = params_of(device);
    p.reply_timeout = reply_timeout;
    SerialCoilDriver driver(p);
    ASSERT_EQ(driver.drive(some_amperes), DriveStatus::driven);
    mute = true;
    double ended = 0;
    std::thread coils([&] {
      EXPECT_EQ(driver.drive(some_amperes), DriveStatus::no_answer);
      ended = steady_seconds();
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const double asked = steady_seconds();
    driver.interrupt();
    coils.join();
    EXPECT_LT(ended - asked, 0.1);
    EXPECT_FALSE(driver.stop());
    EXPECT_LT(device.first(CoilMessage::stop) - asked, 0.2);
    EXPECT_LT(steady_seconds() - asked, 3);
    mute = false;
    EXPECT_EQ(driver.drive(some_amperes), DriveStatus::resumed);  // it heard the stop
  }
}

TEST(SerialCoilDriverPty, ADeviceThatAcknowledgesSomethingElseIsAFault) {
  test::FakeDevice device([](CoilReply& reply) {
    if (reply.to == CoilMessage::set) reply.aim_sum ^= 1;
    return true;
  });
  SerialCoilDriver driver(params_of(device));
  EXPECT_EQ(driver.drive(some_amperes), DriveStatus::mismatched);
}

TEST(SerialCoilDriverPty, ADeviceThatReportsSomethingElseIsAFault) {
  test::FakeDevice device([](CoilReply& reply) {
    reply.outputs = {};
    return true;
  });
  SerialCoilDriver driver(params_of(device));
  EXPECT_EQ(driver.drive(some_amperes), DriveStatus::driven);  // it may not be there yet
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_EQ(driver.drive(some_amperes), DriveStatus::mismatched);
}

TEST(SerialCoilDriverPty, FormerFirmwareIsToldHowToRenewIt) {
  test::FakeDevice device([](CoilReply& reply) {
    reply.version = 1;
    reply.result = CoilResult::wrong_version;
    return true;
  });
  try {
    SerialCoilDriver driver(params_of(device));
    FAIL();
  } catch (const HardwareError& e) {
    EXPECT_TRUE(test::is_one_line_naming(e.what(), device.port(), {"version 1", "make", "upload"}));
  }
}

}  // namespace
}  // namespace microswarm
