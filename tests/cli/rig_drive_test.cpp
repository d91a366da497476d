// SPDX-License-Identifier: Apache-2.0
// `rig drive`: currents and fields by hand.
#include <algorithm>
#include <array>
#include <mutex>

#include "driven_rig.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::test {
namespace {

class RigDrive : public DrivenRig {
 protected:
  Outcome drive(const Arguments& more) const {
    Arguments all{"rig", "drive", "rig.yaml", "--other-stop", "--coils-cold"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
};

TEST_F(RigDrive, ACurrentComesAndGoesByItsRamps) {
  std::vector<int> x, y;
  std::mutex mutex;
  FakeDevice device([&](actuation::CoilReply& reply) {
    const std::lock_guard lock(mutex);
    x.push_back(reply.outputs[0]);
    y.push_back(reply.outputs[1]);
    return true;
  });
  write_rig(device);
  const Outcome outcome = drive({"--currents", "4,0,0", "--seconds", "2", "--ramp", "0.5"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::lock_guard lock(mutex);
  EXPECT_EQ(*std::max_element(x.begin(), x.end()), 400);
  EXPECT_EQ(*std::max_element(y.begin(), y.end()), 0);
  EXPECT_EQ(x.back(), 0);
  int steepest = 0;
  for (std::size_t i = 1; i < x.size(); ++i)
    steepest = std::max(steepest, std::abs(x[i] - x[i - 1]));
  EXPECT_LT(steepest, 200);  // 8 per mille a sending are meant; the computer may be busy
}

TEST_F(RigDrive, EachCoilInTurn) {
  std::array<int, 3> most{};
  std::mutex mutex;
  FakeDevice device([&](actuation::CoilReply& reply) {
    const std::lock_guard lock(mutex);
    for (std::size_t c = 0; c < 3; ++c) most[c] = std::max(most[c], reply.outputs[c]);
    return true;
  });
  write_rig(device);
  const Outcome outcome = drive({"--each", "2", "--seconds", "0.6", "--ramp", "0.2"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* coil : {"coil x, channel 1: 2 A", "coil y, channel 2", "coil z, channel 3"})
    EXPECT_TRUE(names(outcome.out, coil)) << outcome.out;
  EXPECT_EQ(outcome.err.find("to stop"), outcome.err.rfind("to stop")) << outcome.err;
  const std::lock_guard lock(mutex);
  EXPECT_EQ(most, (std::array<int, 3>{200, 200, 200}));
}

TEST_F(RigDrive, TheRigsFieldTurnsAndCtrlCEndsIt) {
  FakeDevice device;
  write_rig(device);
  Program program({"rig", "drive", "rig.yaml", "--other-stop", "--coils-cold", "--heading", "30",
                   "--speed", "20", "--seconds", "60"},
                  at);
  for (int i = 0; i < 1000 && device.count(actuation::CoilMessage::set) < 50; ++i) sleep_ms(10);
  const int stops = device.count(actuation::CoilMessage::stop);
  program.send(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_GT(device.count(actuation::CoilMessage::stop), stops);
}

TEST_F(RigDrive, TheDeviceTurnsTheField) {
  FakeDevice device;
  write_rig(device);
  const Outcome outcome = run({"rig", "drive", "rig.yaml", "--other-stop", "--coils-cold",
                               "--heading", "30", "--speed", "20", "--seconds", "1.5", "--set",
                               "driver.waveforms=true", "--set", "drive_rate_hz=50"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_GT(device.count(actuation::CoilMessage::waveform), 40);
}

TEST_F(RigDrive, WhatCannotBeIsRefused) {
  FakeDevice device;
  write_rig(device);
  for (const Arguments& wrong :
       std::vector<Arguments>{{},
                              {"--currents", "1,2"},
                              {"--currents", "1,0,0", "--field", "1,0,0"},
                              {"--field", "nan,0,0"},
                              {"--currents", "1,0,0", "--seconds", "1", "--ramp", "2"}}) {
    const Outcome outcome = drive(wrong);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
  }
  for (const auto& [wrong, part] : std::vector<std::pair<Arguments, std::string>>{
           {{"--heading", "0", "--speed", "1e6"}, "150 µm/s"},
           {{"--currents", "1e9,0,0"}, "coil 'x' can carry 10 A"},
           {{"--currents", "0,0,-10.1"}, "coil 'z' can carry 10 A"},
           {{"--each", "-50"}, "coil 'x' can carry 10 A"},
           {{"--each", "0"}, "0 A"}}) {
    const Outcome outcome = drive(wrong);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(is_one_line_naming(outcome.err, {}, {wrong[wrong.size() - 2], part}))
        << outcome.err;
  }
  EXPECT_EQ(run({"rig", "drive", "rig.yaml", "--currents", "1,0,0"}).code, 2);  // nobody watches
  write_coils("max_current_a: 10");
  const Outcome outcome = drive({"--currents", "1,0,0"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(names(outcome.err, "does not limit the temperature")) << outcome.err;
  EXPECT_EQ(device.count(actuation::CoilMessage::set), 0);
}

TEST_F(RigDrive, ADeviceThatFallsSilentIsAFault) {
  FakeDevice device([sets = 0](actuation::CoilReply& reply) mutable {
    return reply.to != actuation::CoilMessage::set || ++sets < 30;
  });
  write_rig(device);
  const Outcome outcome = drive({"--currents", "1,0,0", "--seconds", "10"});
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "does not answer")) << outcome.err;
}

}  // namespace
}  // namespace microswarm::test
