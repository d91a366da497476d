// SPDX-License-Identifier: Apache-2.0
// `rig run` as a program that drives a device at a pseudo-terminal.
#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>

#include "driven_rig.hpp"
#include "inputs.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "terminal.hpp"

namespace microswarm::test {
namespace {

class RigRun : public DrivenRig {};

TEST_F(RigRun, DrivesTheDeviceUntilItsTimeIsUp) {
  FakeDevice device;
  write_rig(device);
  const Outcome outcome =
      run(arguments({"--seconds", "2", "--out", "out", "--note", "water, 3rd \x1b[2J chip"}));
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_GT(device.count(actuation::CoilMessage::set), 30);
  EXPECT_TRUE(exists("out/commands.csv"));
  // The record says under which circumstances, what was driven and what was seen, by one clock.
  const experiment::Record record = experiment::read_record(at.folder / "out/run.h5");
  const experiment::RigLog& log = record.rig_log;
  EXPECT_EQ(log.note, "water, 3rd \x1b[2J chip");
  EXPECT_EQ(log.began.substr(0, 2), "20");
  EXPECT_NE(log.rig_file.find("name: bench"), std::string::npos) << log.rig_file;
  EXPECT_NE(log.coils_file.find("helmholtz"), std::string::npos);
  ASSERT_GT(log.driven_at.size(), 30u);
  EXPECT_EQ(log.currents.size(), log.coils.size() * log.driven_at.size());
  EXPECT_GE(log.driven_at.front(), 0);
  EXPECT_LE(log.driven_at.back(), record.frames.back().t + 0.5);
  ASSERT_EQ(log.answered_at.size(), log.driven_at.size());
  ASSERT_EQ(log.pictured_at.size(), log.driven_at.size());
  for (std::size_t k = 0; k < log.driven_at.size(); ++k) {
    EXPECT_LE(log.pictured_at[k], log.driven_at[k]);
    EXPECT_LE(log.driven_at[k], log.answered_at[k]);
  }
  ASSERT_TRUE(log.latency);
  EXPECT_GT(log.latency->pictures, 3);
  EXPECT_GE(log.latency->ticks, log.latency->pictures);
  EXPECT_GT(log.latency->median, 0);
  EXPECT_LE(log.latency->median, log.latency->p99);
  EXPECT_LE(log.latency->p99, log.latency->longest);
  EXPECT_NE(outcome.out.find("camera to current"), std::string::npos) << outcome.out;
  EXPECT_NE(read("out/index.html").find("camera to current"), std::string::npos);
  ASSERT_GT(log.seen_at.size(), 5u);
  EXPECT_EQ(log.bodies.front(), -1);
  const experiment::Frame& frame = record.frames[record.frames.size() / 2];
  ASSERT_TRUE(frame.observed);
  const auto seen = std::ranges::find(log.seen_at, frame.seen);
  ASSERT_NE(seen, log.seen_at.end());
  EXPECT_EQ(log.positions[static_cast<std::size_t>(seen - log.seen_at.begin())].x,
            frame.observed->position.x);
  const std::string commands = read("out/commands.csv");
  const auto rows = split(commands, '\n');
  EXPECT_NEAR(std::stod(std::string(rows[1])), log.driven_at.front(), 1e-3);
  experiment::write_record(record, at.folder / "again.h5");
  EXPECT_EQ(read("again.h5"), read("out/run.h5"));
}

TEST_F(RigRun, TheDeviceTurnsAFieldOfHundredHertz) {
  FakeDevice device;
  write_rig(device);
  const Outcome outcome =
      run(arguments({"--seconds", "3", "--out", "out", "--set-rig", "driver.waveforms=true",
                     "--set-rig", "drive_rate_hz=50", "--set-rig", "field.frequency_hz=100"}));
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_GT(device.count(actuation::CoilMessage::waveform), 60);
  EXPECT_TRUE(exists("out/commands.csv"));
}

TEST_F(RigRun, AStopThatIsNotConfirmedIsAHardwareFault) {
  FakeDevice device([stops = 0](actuation::CoilReply& reply) mutable {
    // The first stop ends the check before the run.
    if (reply.to == actuation::CoilMessage::stop && ++stops > 1) reply.outputs[0] = 300;
    return true;
  });
  write_rig(device);
  const Outcome outcome = run(arguments({"--seconds", "1.5"}));
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "did not confirm")) << outcome.err;
}

TEST_F(RigRun, ARefusedArmSaysSoBeforeTheRun) {
  FakeDevice device([](actuation::CoilReply& reply) {
    if (reply.to == actuation::CoilMessage::arm) reply.result = actuation::CoilResult::not_armed;
    return true;
  });
  write_rig(device);
  const Outcome outcome = run(arguments());
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "does not let itself be armed")) << outcome.err;
  EXPECT_EQ(device.count(actuation::CoilMessage::set), 0);
}

TEST_F(RigRun, ADeviceThatIsOffAgainWithoutCurrentIsNotUsed) {
  FakeDevice device([sets = 0](actuation::CoilReply& reply) mutable {
    if (reply.to == actuation::CoilMessage::set && ++sets % 40 == 0)
      reply.result = actuation::CoilResult::not_armed;
    return true;
  });
  write_rig(device);
  const Outcome outcome = run(arguments());
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "off by themselves")) << outcome.err;
}

TEST_F(RigRun, ADeviceThatLosesItsCurrentsAgainAndAgainEndsIt) {
  FakeDevice device([stops = 0, sets = 0](actuation::CoilReply& reply) mutable {
    stops += reply.to == actuation::CoilMessage::stop;  // the first ends the check before the run
    if (reply.to == actuation::CoilMessage::set && stops > 0 && ++sets % 40 == 0)
      reply.result = actuation::CoilResult::not_armed;
    return true;
  });
  write_rig(device);
  const Outcome outcome = run(arguments({"--seconds", "15"}));
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "had switched off by themselves; armed again")) << outcome.err;
  EXPECT_TRUE(names(outcome.out + outcome.err, "2 times in 10 s, allowed 1")) << outcome.out;
}

TEST_F(RigRun, AfterAStandstillItIsNotDrivenOn) {
  FakeDevice device;
  write_rig(device);
  Program program(arguments({"--seconds", "15", "--set-rig", "safety.max_pause_s=0.3"}), at);
  let_drive(device, 1200);
  program.send(SIGSTOP);
  sleep_ms(800);
  const int before = device.count(actuation::CoilMessage::arm);
  program.send(SIGCONT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_EQ(device.count(actuation::CoilMessage::arm), before);
  EXPECT_TRUE(names(outcome.out + outcome.err, "stood still")) << outcome.out << outcome.err;
  EXPECT_FALSE(names(outcome.err, "times a second")) << "the standstill is no slow line";
}

TEST_F(RigRun, WhatTheCheckRefusesIsRefusedBeforeTheFirstCurrent) {
  FakeDevice device;
  write_rig(device);
  const auto refused_with = [&](const Arguments& more, const std::string& part) {
    const Outcome outcome = run(arguments(more));
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(names(outcome.err, part)) << outcome.err;
    EXPECT_EQ(device.count(actuation::CoilMessage::hello), 0);
  };
  refused_with({"--set-rig", "field.amplitude_mt=500"}, "weaken the field");
  write_coils("max_current_a: 10, max_voltage_v: 24");
  refused_with({}, "does not limit the temperature of every coil");
  write_coils("max_voltage_v: 24, max_temperature_degc: 90");
  refused_with({}, "does not limit the current of every coil");
  EXPECT_EQ(run(arguments({"--without-limits", "--seconds", "1"})).code, 3);
}

TEST_F(RigRun, NobodyWatchingOrADrawnSwarmIsRefused) {
  FakeDevice device;
  write_rig(device);
  const Outcome unwatched =
      run({"rig", "run", "flight.yaml", "--rig", "rig.yaml", "--drawn-swarm"});
  EXPECT_EQ(unwatched.code, 2);
  EXPECT_TRUE(names(unwatched.err, "--other-stop")) << unwatched.err;
  const Outcome drawn = run({"rig", "run", "flight.yaml", "--rig", "rig.yaml", "--other-stop"});
  EXPECT_EQ(drawn.code, 2);
  EXPECT_TRUE(names(drawn.err, "rig.yaml:6:") && names(drawn.err, "--drawn-swarm")) << drawn.err;
  const Outcome drawn_by_aravis =
      run({"rig", "run", "flight.yaml", "--rig", "rig.yaml", "--other-stop", "--set-rig",
           "camera.type=genicam", "--set-rig", "camera.device=Fake_1"});
  EXPECT_EQ(drawn_by_aravis.code, 2);
  EXPECT_TRUE(names(drawn_by_aravis.err, "--drawn-swarm")) << drawn_by_aravis.err;
  EXPECT_EQ(device.count(actuation::CoilMessage::hello), 0);
}

TEST_F(RigRun, AnExperimentIsNotOverwrittenAndALinkNotFollowed) {
  FakeDevice device;
  write_rig(device);
  EXPECT_EQ(run(arguments({"--seconds", "1", "--out", "out"})).code, 3);
  const std::string before = read("out/run.h5");
  const Outcome again = run(arguments({"--seconds", "1", "--out", "out"}));
  EXPECT_EQ(again.code, 2);
  EXPECT_TRUE(names(again.err, "out/run.h5: ") && names(again.err, "--overwrite")) << again.err;
  EXPECT_EQ(read("out/run.h5"), before);
  // A log that a killed run left is an experiment as well.
  fs::create_directories(at.folder / "killed");
  write("killed/commands.csv.part", "t_s\n");
  EXPECT_EQ(run(arguments({"--seconds", "1", "--out", "killed"})).code, 2);
  EXPECT_EQ(read("killed/commands.csv.part"), "t_s\n");
  write("precious", "mine");
  fs::create_directories(at.folder / "trap");
  fs::create_symlink("../precious", at.folder / "trap/commands.csv.part");
  EXPECT_EQ(run(arguments({"--seconds", "1", "--out", "trap", "--overwrite"})).code, 3);
  EXPECT_EQ(read("precious"), "mine");
  EXPECT_TRUE(exists("trap/commands.csv"));
}

TEST_F(RigRun, TemperaturesOutliveTheProgram) {
  FakeDevice device;
  write_rig(device);
  const auto kept = [&] {
    for (const std::string& file : files())
      if (file.starts_with(".state/") && !names(file, ".tmp-microswarm-")) return read(file);
    return std::string("none");
  };
  const auto temperature = [&] {
    const std::string text = kept();
    const std::size_t key = text.find("temperatures_degc");
    return key == std::string::npos ? 0
                                    : std::stod(text.substr(text.find_first_of("0123456789", key)));
  };
  // Nothing is known: at the limit, until somebody says that they are cold.
  Arguments unknown = arguments({"--seconds", "1"});
  std::erase(unknown, "--coils-cold");
  const Outcome first = run(unknown);
  EXPECT_EQ(first.code, 3) << first.err;
  EXPECT_TRUE(names(first.err, "--coils-cold")) << first.err;
  EXPECT_TRUE(names(kept(), "driven: false")) << kept();
  EXPECT_GT(temperature(), 89) << kept();
  // From then on they are known, also after a program that was killed.
  const int armed = device.count(actuation::CoilMessage::arm);
  Program program(arguments(), at);
  let_drive(device, 1500, armed);
  program.send(SIGKILL);
  EXPECT_EQ(program.wait().signal, SIGKILL);
  EXPECT_TRUE(names(kept(), "driven: true")) << kept();
  EXPECT_LT(temperature(), 30);
  const Outcome last = run(unknown);
  EXPECT_EQ(last.code, 3) << last.err;
  EXPECT_FALSE(names(last.err, "--coils-cold")) << last.err;
  // Two seconds of 10 A count that the killed program may have driven.
  EXPECT_GT(temperature(), 22.5);
  EXPECT_LT(temperature(), 40);
}

/// Where the temperatures of the coils are kept; empty before the first run.
std::string state_of(const std::set<std::string>& files) {
  const auto found = std::ranges::find_if(
      files, [](const std::string& file) { return file.starts_with(".state/"); });
  return found == files.end() ? std::string() : *found;
}

TEST_F(RigRun, TheFileOfTemperaturesIsNoWayToAnother) {
  FakeDevice device;
  write_rig(device);
  ASSERT_EQ(run(arguments({"--seconds", "0.5"})).code, 3);
  const std::string kept = state_of(files());
  ASSERT_FALSE(kept.empty());
  const fs::path file = at.folder / kept;
  Arguments warm = arguments({"--seconds", "0.5"});
  std::erase(warm, "--coils-cold");
  const auto is_refused = [&] {
    const Outcome outcome = run(warm);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(names(outcome.err, file.filename().string())) << outcome.err;
    EXPECT_FALSE(names(outcome.err, "tr0ub4dor")) << outcome.err;
  };
  write("secret", "tr0ub4dor: 3\n");
  const std::string before = read(kept);
  for (const fs::path& target :
       {at.folder / "secret", at.folder / "nothing", fs::path("/dev/full")}) {
    fs::remove(file);
    fs::create_symlink(target, file);
    is_refused();
    EXPECT_TRUE(fs::is_symlink(file)) << target;
    // What is written takes the link's place.
    EXPECT_EQ(run(arguments({"--seconds", "0.5"})).code, 3) << target;
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(file))) << target;
    EXPECT_FALSE(exists("nothing"));
  }
  EXPECT_EQ(read("secret"), "tr0ub4dor: 3\n");
  for (const std::string text : {"tr0ub4dor", "coils: tr0ub4dor\n", "clock_s: tr0ub4dor\n"}) {
    write(kept, text);
    is_refused();
  }
  write(kept, before.substr(0, before.find("temperatures")) + "temperatures_degc: [20]\n");
  is_refused();
}

TEST_F(RigRun, CurrentsThatTheDeviceWeakensAreToldAsItHappens) {
  FakeDevice device;
  write_rig(device);
  Terminal terminal(arguments({"--seconds", "30"}), at);
  let_drive(device, 500);
  EXPECT_FALSE(names(terminal.said(), "weakens"));
  for (std::size_t c = 0; c < 3; ++c) device.limit(c, 200);
  EXPECT_TRUE(terminal.hears("the device weakens the currents to")) << terminal.said();
  terminal.press("\x03");
  EXPECT_EQ(terminal.wait(), 3) << terminal.said();
}

TEST_F(RigRun, AProbeIsShownByTheCheckAndNamedWhenItBreaks) {
  std::atomic<int> sets = 0;
  FakeDevice device([&](actuation::CoilReply& reply) {
    sets += reply.to == actuation::CoilMessage::set;
    reply.probe = 1;
    reply.temperature = sets < 100 ? 312 : actuation::coil_link_probe_open;
    return true;
  });
  write_rig(device);
  const Outcome check = run({"rig", "check", "rig.yaml", "--seconds", "0.2"});
  EXPECT_TRUE(names(check.out, "y 31.2 °C")) << check.out;
  sets = 0;
  const Outcome outcome = run(arguments({"--seconds", "3"}));
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  const std::string note = "the probe of channel 2 is open";
  const std::size_t first = outcome.err.find(note);
  EXPECT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find(note, first + 1), std::string::npos) << outcome.err;
}

TEST_F(RigRun, CurrentsThatTheDeviceWeakensAgainAndAgainAreToldSeldom) {
  FakeDevice device;
  write_rig(device);
  Program program(arguments({"--seconds", "4"}), at);
  let_drive(device, 300);
  for (int i = 0; i < 12; ++i) {
    for (std::size_t c = 0; c < 3; ++c) device.limit(c, i % 2 == 0 ? 200 : 1000);
    sleep_ms(150);
  }
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  const std::string told = "the device weakens the currents to";
  const std::size_t first = outcome.err.find(told);
  ASSERT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find(told, first + 1), std::string::npos) << outcome.err;
}

/// A folder of pictures as the camera.
TEST_F(RigRun, APictureThatCannotBeReadIsNamed) {
  write("rig.yaml",
        "name: bench\ncoils: coils.yaml\nfield: {kind: rotating, amplitude_mt: 8, frequency_hz: "
        "10, max_pitch_deg: 7.5}\nscale: {um_per_px: 10, origin_px: [0, 99]}\n"
        "camera: {type: video, file: pictures, rate_hz: 5}\n"
        "safety: {lost_swarm_s: 100, missed_deadlines: 100, max_pause_s: 3}\n");
  fs::create_directory(at.folder / "pictures");
  const auto draw = [&] {
    for (int k = 100; k < 200; ++k)
      write("pictures/" + std::to_string(k) + ".pgm",
            pgm(200, 100, [k](int x, int y) { return 150 + (x * y + k) % 50; }));
  };
  const Arguments dry{"rig",      "run",       "flight.yaml", "--rig",
                      "rig.yaml", "--dry-run", "--seconds",   "15"};
  draw();
  write("pictures/108.pgm", "P5\n200 100\n255\n");
  const Outcome damaged = run(dry);
  EXPECT_EQ(damaged.code, 4) << damaged.out << damaged.err;
  EXPECT_TRUE(names(damaged.out + damaged.err, "pictures/108.pgm")) << damaged.out << damaged.err;
  draw();
  Program program(dry, at);
  program.let_work(2000);
  fs::rename(at.folder / "pictures", at.folder / "moved");
  const Outcome moved = program.wait();
  EXPECT_EQ(moved.code, 4) << moved.out << moved.err;
  EXPECT_TRUE(names(moved.out + moved.err, "pictures")) << moved.out << moved.err;
}

TEST_F(RigRun, ADamagedFileOfTemperaturesIsRefusedInALineThatSaysWhatHelps) {
  FakeDevice device;
  write_rig(device);
  EXPECT_EQ(run(arguments({"--seconds", "0.5"})).code, 3);
  const std::string state = state_of(files());
  const std::string good = read(state);
  Arguments again = arguments({"--seconds", "0.5"});
  std::erase(again, "--coils-cold");
  for (const std::string& damaged :
       {std::string(), good.substr(0, good.size() / 2), std::string("\x00\xff\x00", 3),
        with(good, "temperatures_degc", "temperatures_degc: [20, .nan, x]"),
        std::string("[1, 2")}) {
    write(state, damaged);
    const Outcome outcome = run(again);
    EXPECT_EQ(outcome.code, 2) << damaged << outcome.err;
    EXPECT_TRUE(is_one_line_naming(outcome.err, {}, {fs::path(state).filename(), "--coils-cold"}))
        << damaged << outcome.err;
    EXPECT_EQ(read(state), damaged);
  }
  EXPECT_EQ(run(arguments({"--seconds", "0.5"})).code, 3);
  // Of another number of coils: neither believed nor overwritten, cold or not.
  const std::string other = with(good, "temperatures_degc", "temperatures_degc: [20, 20]");
  write(state, other);
  for (const Arguments& any : {again, arguments({"--seconds", "0.5"})}) {
    const Outcome outcome = run(any);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(is_one_line_naming(outcome.err, {},
                                   {fs::path(state).filename(), "2 temperatures", "3 coils"}))
        << outcome.err;
    EXPECT_EQ(read(state), other);
  }
}

TEST_F(RigRun, KeptTemperaturesBelowAmbientAreNotBelieved) {
  FakeDevice device;
  write_rig(device);
  EXPECT_EQ(run(arguments({"--seconds", "0.5"})).code, 3);
  const std::string state = state_of(files());
  write(state, with(read(state), "temperatures_degc", "temperatures_degc: [-270, -270, 50]"));
  Arguments again = arguments({"--seconds", "0.5"});
  std::erase(again, "--coils-cold");
  EXPECT_EQ(run(again).code, 3);
  EXPECT_EQ(read(state).find("-2"), std::string::npos) << read(state);
}

}  // namespace
}  // namespace microswarm::test
