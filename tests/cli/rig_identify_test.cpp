// SPDX-License-Identifier: Apache-2.0
// `rig identify` from the command line, and the commissioning record that it writes.
#include <nlohmann/json.hpp>
#include "driven_rig.hpp"

#include "microswarm/experiment/record/record.hpp"
#include "terminal.hpp"

namespace microswarm::test {
namespace {

class RigIdentify : public DrivenRig {
 protected:
  RigIdentify() {
    write("dish.yaml",
          "map: {type: polygons, lo_um: [0, 0], hi_um: [1600, 1600]}\n"
          "start: {x_um: 800, y_um: 800}\ngoal_um: [1200, 800]\ntime_limit_s: 60\n"
          "swarm: {type: vortex, radius_um: 80, moving_radius_um: 80, max_speed_um_per_s: 60}\n"
          "navigator: {type: radar}\n");
    write("rig.yaml",
          "# my rig\nname: bench\ncoils: coils.yaml  # the coils\n"
          "field: {kind: rotating, amplitude_mt: 8, frequency_hz: 10, max_pitch_deg: 7.5}\n"
          "drive_rate_hz: 100\n"
          "camera: {type: simulated, microscope: {um_per_px: 4}}\n"
          "safety: {lost_swarm_s: 3, max_frame_age_s: 3, deadman_s: 3, missed_deadlines: 100, "
          "max_pause_s: 3}\n");
  }
  static Arguments identify(const Arguments& more = {}) {
    Arguments all{"rig", "identify", "rig.yaml", "--scenario", "dish.yaml", "--seconds", "20"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

TEST_F(RigIdentify, WritesWhatItMeasuredAndEntersItInTheRecord) {
  const std::string before = read("rig.yaml");
  const Outcome driven = run(identify({"--out", "out", "--set-rig", "camera.speed_error=-0.3",
                                       "--set-rig", "camera.direction_error_deg=12", "--json"}));
  ASSERT_EQ(driven.code, 0) << driven.err;
  EXPECT_EQ(read("rig.yaml"), before);
  for (const char* name : {"run.h5", "identify.json", "identify.png", "commands.csv"})
    EXPECT_TRUE(exists(std::string("out/") + name)) << name;
  const auto told = nlohmann::json::parse(driven.out);
  EXPECT_FALSE(told["written"]);
  EXPECT_NEAR(told["gain"]["value"].get<double>(), 0.7, 0.05);
  EXPECT_NEAR(told["angle_deg"]["value"].get<double>(), 12, 5);

  // The record says the same, and is written from.
  const Outcome fitted =
      run({"rig", "identify", "rig.yaml", "--record", "out/run.h5", "--write", "--by", "ann"});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  const std::string after = read("rig.yaml");
  EXPECT_TRUE(after.starts_with("# my rig\nname: bench\ncoils: coils.yaml  # the coils\nfield: "))
      << after;
  for (const char* key : {"speed_per_pitch_um_per_s: ", "heading_offset_deg: ", "delay_s: "})
    EXPECT_NE(after.find(key), std::string::npos) << after;
  EXPECT_NE(read("rig.commissioning.yaml").find("by: ann"), std::string::npos);

  const Outcome check = run({"rig", "check", "rig.yaml", "--seconds", "0.1"});
  EXPECT_TRUE(names(check.out, "by ann today")) << check.out;
  const Outcome stale = run({"rig", "check", "rig.yaml", "--seconds", "0.1", "--set", "delay_s=3"});
  EXPECT_TRUE(names(stale.out, "keys have changed since: delay")) << stale.out;
  const Outcome flown = run({"rig", "run", "dish.yaml", "--rig", "rig.yaml", "--seconds", "0.5",
                             "--json", "--out", "flight"});
  EXPECT_TRUE(names(flown.err, "by ann today")) << flown.err;
  EXPECT_EQ(run({"rig", "identify", "rig.yaml", "--record", "out/run.h5", "--set-rig",
                 "field.kind=oscillating"})
                .code,
            2);
  EXPECT_EQ(nlohmann::json::parse(flown.out)["commissioning"]["measured"][0]["by"], "ann");
  const experiment::Record record = experiment::read_record(at.folder / "flight/run.h5");
  EXPECT_NE(record.rig_log.commissioning.find("by: ann"), std::string::npos);
}

TEST_F(RigIdentify, ARunThatRequiresTheRecordIsRefusedWithoutIt) {
  const Arguments flight{"rig",
                         "run",
                         "dish.yaml",
                         "--rig",
                         "rig.yaml",
                         "--set-rig",
                         "safety.require_commissioning=true",
                         "--seconds",
                         "0.5"};
  const Outcome refused = run(flight);
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_TRUE(names(refused.err, "never measured: gain, angle, delay, step_out")) << refused.err;
}

TEST_F(RigIdentify, WithoutRoomOrUseItIsRefused) {
  const std::string before = read("rig.yaml");
  const Outcome narrow = run(identify({"--set", "start.y_um=180", "--write"}));
  EXPECT_EQ(narrow.code, 2) << narrow.err;
  EXPECT_TRUE(names(narrow.err, "no room")) << narrow.err;
  EXPECT_EQ(run({"rig", "identify", "rig.yaml"}).code, 2);
  EXPECT_EQ(run(identify({"--by-hand"})).code, 2);
  EXPECT_EQ(run(identify({"--max-frequency", "80"})).code, 2);
  EXPECT_EQ(read("rig.yaml"), before);
}

TEST_F(RigIdentify, CtrlCAndALostSwarmWriteNothing) {
  const std::string before = read("rig.yaml");
  {
    Terminal terminal(identify({"--write"}), at);
    ASSERT_TRUE(terminal.hears("square")) << terminal.said();
    sleep_ms(2000);
    terminal.send(SIGINT);
    EXPECT_EQ(terminal.wait(), 3) << terminal.said();
    EXPECT_TRUE(names(terminal.said(), "nothing is written")) << terminal.said();
  }
  const Outcome lost = run(identify({"--write", "--set-rig", "camera.microscope.swarm_depth=0"}));
  EXPECT_NE(lost.code, 0) << lost.err;
  EXPECT_EQ(read("rig.yaml"), before);
  EXPECT_FALSE(exists("rig.commissioning.yaml"));
}

TEST_F(RigIdentify, AtATerminalItAsks) {
  ASSERT_EQ(run(identify({"--out", "out"})).code, 0);
  const std::string before = read("rig.yaml");
  const Arguments fit{"rig", "identify", "rig.yaml", "--record", "out/run.h5"};
  {
    Terminal terminal(fit, at);
    ASSERT_TRUE(terminal.hears("y or n")) << terminal.said();
    terminal.press("n\r");
    EXPECT_EQ(terminal.wait(), 0) << terminal.said();
    EXPECT_EQ(read("rig.yaml"), before);
  }
  // What was driven with another field says nothing about this one.
  std::string other = before;
  other.replace(other.find("amplitude_mt: "), std::string("amplitude_mt: 8").size(),
                "amplitude_mt: 7");
  write("other.yaml", other);
  const Outcome refused =
      run({"rig", "identify", "other.yaml", "--record", "out/run.h5", "--write"});
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_TRUE(names(refused.err, "another field or scale")) << refused.err;
  EXPECT_EQ(read("other.yaml"), other);
  EXPECT_FALSE(exists("other.commissioning.yaml"));
  Terminal terminal(fit, at);
  ASSERT_TRUE(terminal.hears("y or n")) << terminal.said();
  terminal.press("y\r");
  EXPECT_EQ(terminal.wait(), 0) << terminal.said();
  EXPECT_NE(read("rig.yaml"), before);
}

TEST_F(RigIdentify, DrivenByHandItIsFitted) {
  Terminal terminal(identify({"--by-hand", "--write"}), at);
  ASSERT_TRUE(terminal.hears("arrow keys")) << terminal.said();
  for (const char* key : {"\x1b[C", "\x1b[A", "\x1b[D", "\x1b[B"})
    for (int i = 0; i < 8; ++i) {
      terminal.press(key);
      sleep_ms(300);
    }
  terminal.press("q");
  EXPECT_EQ(terminal.wait(), 0) << terminal.said();
  EXPECT_TRUE(names(terminal.said(), "no sweep was driven")) << terminal.said();
  EXPECT_NE(read("rig.yaml").find("delay_s: "), std::string::npos) << terminal.said();
}

TEST_F(RigIdentify, ADeviceThatFallsSilentIsAFaultAndNothingIsWritten) {
  std::atomic<bool> silent = false;
  FakeDevice device([&](actuation::CoilReply&) { return !silent; });
  write_rig(device);
  const std::string before = read("rig.yaml");
  Program program(
      identify({"--write", "--other-stop", "--drawn-swarm", "--coils-cold", "--out", "out"}), at);
  let_drive(device, 1500);
  silent = true;
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_EQ(read("rig.yaml"), before);
  EXPECT_FALSE(exists("rig.commissioning.yaml"));
  EXPECT_TRUE(exists("out/run.h5"));
}

TEST_F(RigIdentify, AStoppedSwarmIsNotWritten) {
  const std::string before = read("rig.yaml");
  const Outcome stuck = run(identify({"--write", "--set-rig", "camera.speed_error=-0.9"}));
  EXPECT_NE(stuck.code, 0) << stuck.err;
  EXPECT_EQ(read("rig.yaml"), before);
}

}  // namespace
}  // namespace microswarm::test
