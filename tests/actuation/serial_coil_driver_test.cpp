// SPDX-License-Identifier: Apache-2.0
// What the driver makes of a device that refuses, is silent, or does something else.
#include "microswarm/actuation/drivers/serial_coil_driver.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <stop_token>
#include <string>
#include <thread>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "tests/actuation/fake_device.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
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

/// Message of a driver that finds no firmware at the port.
std::string refusal(const std::string& port, double timeout) {
  SerialCoilParams p;
  p.port = port;
  p.boot_time = 0;
  p.connect_timeout = timeout;
  try {
    const SerialCoilDriver driver(p);
  } catch (const HardwareError& e) {
    return e.what();
  }
  return "connected";
}

TEST(SerialCoilDriverPty, WhatSaysSomethingElseIsQuoted) {
  test::Pty other;
  std::jthread talks([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      other.say("Grbl 1.1f ['$' for help]\r\n");
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  const std::string why = refusal(other.port(), 0.5);
  EXPECT_TRUE(why.starts_with(other.port() + ": no answer within 0.5 s; it said '")) << why;
  EXPECT_NE(why.find("for help"), std::string::npos) << why;
  EXPECT_TRUE(why.ends_with("', which is no answer")) << why;
}

TEST(SerialCoilDriverPty, APortThatVanishesIsSaidAtOnce) {
  test::Pty other;
  std::jthread vanishes([&] {
    other.await_input();
    other.close_line();
  });
  EXPECT_EQ(refusal(other.port(), 30),
            other.port() + ": the port has vanished: Input/output error");
}

/// Trouble of a driver after so many requests that a device leaves without an answer.
std::string trouble_of(SerialCoilDriver& driver, int requests = max_missed_answers) {
  for (int k = 0; k < requests; ++k)
    EXPECT_EQ(driver.drive(some_amperes), DriveStatus::no_answer) << k;
  return trouble_text(driver, DriveStatus::no_answer);
}

TEST(SerialCoilDriverPty, ALineThatIsBrokenOneWayIsSaid) {
  const test::Pty mute;
  const std::string why = refusal(mute.port(), 0.1);
  EXPECT_TRUE(test::names(why, "nothing came back, messages sent: ")) << why;
  std::atomic<bool> silent = false;
  test::FakeDevice device([&](CoilReply&) { return !silent; });
  SerialCoilParams p = params_of(device);
  p.attempts = 2;
  SerialCoilDriver driver(p);
  ASSERT_EQ(driver.drive(some_amperes), DriveStatus::driven);
  silent = true;
  EXPECT_EQ(trouble_of(driver),
            "the coil driver does not answer: nothing came back, messages sent: 6");
}

TEST(SerialCoilDriverPty, AFloodIsSaidWithItsBytes) {
  const test::Pty other;
  std::jthread talks([&](const std::stop_token& stop) {
    other.await_input();
    while (!stop.stop_requested()) {
      other.say(std::string(500, 'x'));
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  const std::string why = refusal(other.port(), 0.5);
  EXPECT_TRUE(test::names(why, "it floods the line")) << why;
  EXPECT_TRUE(test::names(why, "bytes without an answer")) << why;
}

TEST(SerialCoilDriverPty, LateAnswersAreSaidWithTheirDelayAndTheTimeAllowed) {
  std::atomic<int> late_ms = 0;
  test::FakeDevice device([&](CoilReply&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(late_ms));
    return true;
  });
  SerialCoilParams p = params_of(device);
  p.reply_timeout = 0.05;
  p.attempts = 1;
  SerialCoilDriver driver(p);
  ASSERT_EQ(driver.drive(some_amperes), DriveStatus::driven);
  late_ms = 70;
  const std::string why = trouble_of(driver);
  EXPECT_TRUE(test::names(why, "does not answer: its answer came after ")) << why;
  EXPECT_TRUE(test::names(why, " ms, reply_timeout_s is 0.05")) << why;
}

/// The device does not obey what waited on the line.
TEST(SerialCoilDriverPty, AMessageThatCameTooLateIsSaid) {
  test::FakeDevice device([](CoilReply& reply) {
    if (reply.to == CoilMessage::set) reply.result = CoilResult::stale;
    return true;
  });
  SerialCoilDriver driver(params_of(device));
  const std::string why = trouble_of(driver, 1);
  EXPECT_TRUE(test::names(why, "too late")) << why;
  EXPECT_TRUE(test::names(why, " ms, reply_timeout_s is 0.09")) << why;
}

TEST(SerialCoilDriverPty, ATripIsToldAlsoWhenTheCurrentsAreScaled) {
  test::FakeDevice device([sets = 0](CoilReply& reply) mutable {
    if (reply.to == CoilMessage::set && ++sets == 1) reply.result = CoilResult::not_armed;
    if (reply.to == CoilMessage::set && sets == 2) {
      reply.result = CoilResult::limited;
      reply.scale = coil_link_unscaled / 2;
      CoilAim aim;
      for (std::size_t c = 0; c < 6; ++c)
        aim.constant[c] = static_cast<int>(std::lround(some_amperes[c] / 20 * 1000));
      reply.aim_sum = check_sum(scaled(aim, reply.scale));
    }
    return true;
  });
  SerialCoilDriver driver(params_of(device));
  EXPECT_EQ(driver.drive(some_amperes), DriveStatus::resumed);
  EXPECT_EQ(driver.report().scale, 0.5);
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
    EXPECT_FALSE(driver.stop().confirmed);
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
  for (const int version : {1, 2}) {
    test::FakeDevice device([&](CoilReply& reply) {
      reply.version = version;
      reply.result = CoilResult::wrong_version;
      return true;
    });
    try {
      SerialCoilDriver driver(params_of(device));
      FAIL();
    } catch (const HardwareError& e) {
      EXPECT_TRUE(
          test::is_one_line_naming(e.what(), device.port(),
                                   {"version " + std::to_string(version),
                                    "microswarm rig flash, port " + device.port(), "settings"}));
    }
  }
}

TEST(SerialCoilDriverPty, AProbeWarmsTheModelAndABrokenOneIsNamed) {
  std::atomic<int> second = 715;  // [0.1 °C]
  test::FakeDevice device([&, next = 0](CoilReply& reply) mutable {
    reply.probe = static_cast<std::uint8_t>(next++ % coil_link_channels);
    if (reply.probe == 0) reply.temperature = 180;
    if (reply.probe == 1) reply.temperature = second;
    return true;
  });
  SerialCoilDriver driver(params_of(device));
  const CoilSystem system = read_coil_system(std::filesystem::path(MICROSWARM_SOURCE_DIR) /
                                             "scenarios/rigs/helmholtz.yaml");
  CoilController controller(system, {}, driver, 0);
  controller.command(Eigen::VectorXd(Eigen::Vector3d::Zero()));
  for (int k = 0; k < 8; ++k) ASSERT_EQ(controller.advance(1e-3).status, DriveStatus::driven);
  EXPECT_NEAR(controller.temperatures()[1], 71.5, 0.1);
  EXPECT_GT(controller.temperatures()[0], 18.5);  // the model: a probe never cools it
  EXPECT_EQ(controller.output().probe_trouble, "");
  second = coil_link_probe_open;
  for (int k = 0; k < 8; ++k) ASSERT_EQ(controller.advance(1e-3).status, DriveStatus::driven);
  EXPECT_EQ(controller.output().probe_trouble, "the probe of channel 2 is open");
  EXPECT_NEAR(controller.temperatures()[1], 71.5, 0.1);
}

TEST(SerialCoilDriverPty, AWaveformGoesOnByItselfAndTellsItsPhase) {
  std::atomic<int> told = 0;  // by the device
  test::FakeDevice device([&](CoilReply& reply) {
    told = reply.phase;
    return true;
  });
  SerialCoilParams p = params_of(device);
  p.waveforms = true;
  SerialCoilDriver driver(p);
  const std::array<double, 6> none{}, cosine{10, 0, 0, 0, 0, 5}, sine{0, -10, 0, 0, 0, 5};
  const double phase = 1.5;
  // The waveform begins and each of its phases is read at some time of an exchange.
  const double begins_after = steady_seconds();
  ASSERT_EQ(driver.drive(CurrentWaveform{100, phase, none, cosine, sine}), DriveStatus::driven);
  const double begins_before = steady_seconds();
  for (int k = 0; k < 20; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(7));
    // A new phase is not asked for: the waveform that runs goes on at its own.
    const double read_after = steady_seconds();
    ASSERT_EQ(driver.drive(CurrentWaveform{100, 0, none, cosine, sine}), DriveStatus::driven);
    const double read_before = steady_seconds();
    ASSERT_TRUE(driver.report().phase);
    EXPECT_NEAR(wrap(*driver.report().phase - 2 * pi * told / 65536), 0, 1e-9);
    const double least = phase + 2 * pi * 100 * (read_after - begins_before);
    const double most = phase + 2 * pi * 100 * (read_before - begins_after);
    const double off = std::abs(wrap(*driver.report().phase - (least + most) / 2));
    EXPECT_LE(off, (most - least) / 2 + 0.001);
    EXPECT_NEAR(driver.report().currents[0], 10 * std::cos(*driver.report().phase), 0.05);
    EXPECT_NEAR(driver.report().currents[1], -10 * std::sin(*driver.report().phase), 0.05);
  }
  EXPECT_EQ(driver.drive(some_amperes), DriveStatus::driven);
  EXPECT_FALSE(driver.report().phase);
}

TEST(SerialCoilDriverPty, RefusesWaveformsBeyondItsScale) {
  test::FakeDevice device;
  SerialCoilDriver driver(params_of(device));
  const std::array<double, 6> none{}, most{20, 0, 0, 0, 0, 0}, little{1, 0, 0, 0, 0, 0};
  EXPECT_EQ(driver.drive(CurrentWaveform{501, 0, none, little, none}), DriveStatus::refused);
  EXPECT_EQ(driver.drive(CurrentWaveform{16, 0, little, most, none}), DriveStatus::refused);
  EXPECT_EQ(driver.drive(CurrentWaveform{16, 0, none, most, little}), DriveStatus::refused);
  EXPECT_EQ(driver.drive(CurrentWaveform{-16, 0, none, most, none}), DriveStatus::driven);
}

}  // namespace
}  // namespace microswarm::actuation
