// SPDX-License-Identifier: Apache-2.0
// `rig run` operated by keys at a terminal, and its status line.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "driven_rig.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "terminal.hpp"

namespace microswarm::test {
namespace {

constexpr const char* esc = "\x1b";
constexpr const char* up = "\x1b[A";
constexpr const char* left = "\x1bOD";  // of a terminal with application keys

std::ptrdiff_t frames_in(const experiment::Record& record, NavigatorState state) {
  return std::ranges::count(record.frames, state, &experiment::Frame::state);
}

/// What a terminal shows: the lines that are complete or renewed, without sequences.
std::vector<std::string> shown_lines(const std::string& said) {
  std::vector<std::string> lines{""};
  for (std::size_t i = 0; i < said.size(); ++i) {
    if (said.compare(i, 3, "\x1b[K") == 0) {
      i += 2;
    } else if (said[i] == '\r' || said[i] == '\n') {
      if (!lines.back().empty()) lines.emplace_back();
    } else {
      lines.back() += said[i];
    }
  }
  return lines;
}

std::size_t width_of(const std::string& line) {
  return static_cast<std::size_t>(
      std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; }));
}

class RigOperation : public DrivenRig {
 protected:
  RigOperation() { write_rig(device); }
  static Arguments arguments(const Arguments& more = {}) {
    Arguments all{"rig",           "run",          "flight.yaml", "--rig", "rig.yaml",
                  "--drawn-swarm", "--coils-cold", "--out",       "out"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// One that begins `near` the goal [µm].
  static Arguments near_goal(const std::string& hold) {
    return arguments(
        {"--set", "goal_um=[470, 500]", "--set", "goal_tolerance_um=40", "--hold", hold});
  }
  void let_drive(int ms, int armed = 0) { DrivenRig::let_drive(device, ms, armed); }
  experiment::Record record() const { return experiment::read_record(at.folder / "out/run.h5"); }

  std::atomic<int> strongest = 0;  // output of the last set [‰]
  FakeDevice device{[this](actuation::CoilReply& reply) {
    if (reply.to == actuation::CoilMessage::set || reply.to == actuation::CoilMessage::stop)
      strongest = std::abs(*std::ranges::max_element(reply.outputs, {},
                                                     [](int output) { return std::abs(output); }));
    return true;
  }};
};

TEST_F(RigOperation, PauseHoldsAndResumes) {
  Terminal terminal(arguments(), at);
  let_drive(1000);
  terminal.press("p");
  EXPECT_TRUE(terminal.hears("paused")) << terminal.said();
  sleep_ms(1500);
  EXPECT_GT(strongest, 0);  // the field goes on
  terminal.skip();
  terminal.press("P");
  EXPECT_TRUE(terminal.hears("seen")) << terminal.said();
  sleep_ms(1000);
  terminal.press("q");
  EXPECT_EQ(terminal.wait(), 3) << terminal.said();
  const experiment::Record run = record();
  EXPECT_EQ(run.result.status, Status::stopped);
  EXPECT_GE(frames_in(run, NavigatorState::paused), 12);
  for (const experiment::Frame& frame : run.frames)
    if (frame.state == NavigatorState::paused) {
      EXPECT_EQ(frame.command.speed, 0);
    }
  EXPECT_GT(run.frames[run.frames.size() - 2].command.speed, 0);
  EXPECT_TRUE(terminal.is_as_a_shell_wants_it());
}

TEST_F(RigOperation, ByHandTheSwarmGoesWhereTheKeysSay) {
  // Room for 0.3 mm in each direction: no safe move begins on a wall.
  Terminal terminal(arguments({"--set", "map.hi_um=[3000, 2000]", "--set", "start.x_um=1000",
                               "--set", "start.y_um=1000", "--set", "goal_um=[2500, 1000]"}),
                    at);
  let_drive(500);
  terminal.press("m");
  EXPECT_TRUE(terminal.hears("manual")) << terminal.said();
  for (int i = 0; i < 4; ++i) terminal.press("+");
  for (int i = 0; i < 20; ++i) {
    terminal.press(up);
    sleep_ms(100);
  }
  terminal.press("\x1b[A\x1b[C");  // two at once: the last one counts
  sleep_ms(250);
  for (int i = 0; i < 20; ++i) {
    terminal.press(left);
    sleep_ms(100);
  }
  sleep_ms(1500);  // without keys it holds
  terminal.press("m");
  sleep_ms(2000);
  terminal.press("q");
  EXPECT_EQ(terminal.wait(), 3) << terminal.said();
  const experiment::Record run = record();
  std::vector<experiment::Frame> hands;
  std::ranges::copy_if(run.frames, std::back_inserter(hands), [](const experiment::Frame& f) {
    return f.state == NavigatorState::manual;
  });
  ASSERT_GT(hands.size(), 20u);
  EXPECT_GT(hands[hands.size() / 2].pose.position.y, hands.front().pose.position.y + 30);
  EXPECT_LT(hands.back().pose.position.x, hands[hands.size() / 2].pose.position.x - 10);
  EXPECT_EQ(hands.back().command.speed, 0);
  const double fastest = std::ranges::max(hands, {}, [](const experiment::Frame& f) {
                           return f.command.speed;
                         }).command.speed;
  const double limit = swarm_limits(run.scene.scenario.swarm).max_speed;
  EXPECT_NEAR(fastest, 0.9 * limit, 1e-6);
  const auto is_steered = [&](double heading) {
    return std::ranges::any_of(hands, [&](const experiment::Frame& f) {
      return f.command.speed > 0 && std::abs(f.command.heading - heading) < 1e-9;
    });
  };
  EXPECT_TRUE(is_steered(std::acos(0)));
  EXPECT_TRUE(is_steered(0));
  EXPECT_TRUE(is_steered(std::acos(-1)));
  EXPECT_FALSE(is_steered(-std::acos(0)));
  const experiment::Frame& after = run.frames[run.frames.size() - 2];
  EXPECT_EQ(after.state, NavigatorState::direct);
  EXPECT_GT(after.command.speed, 0);
}

TEST_F(RigOperation, ALoneEscEndsItAtOnce) {
  Terminal terminal(arguments(), at);
  let_drive(700);
  for (int i = 0; i < 3; ++i) terminal.press(up);  // no emergency
  sleep_ms(300);
  ASSERT_TRUE(terminal.running());
  const int stops = device.count(actuation::CoilMessage::stop);
  const double pressed = steady_seconds();
  terminal.press(esc);
  while (device.count(actuation::CoilMessage::stop) == stops && steady_seconds() < pressed + 5)
    sleep_ms(1);
  EXPECT_LT(steady_seconds() - pressed, 0.15);  // 0.05 s are meant; the computer may be busy
  RecordProperty("seconds_to_stop", std::to_string(steady_seconds() - pressed));
  EXPECT_EQ(terminal.wait(), 4) << terminal.said();
  EXPECT_TRUE(names(terminal.said(), "emergency key"));
  EXPECT_TRUE(terminal.is_as_a_shell_wants_it());
}

TEST_F(RigOperation, EmergencyKeysActInEveryState) {
  for (const auto& [keys, emergency] :
       {std::pair{"p", " "}, {"m", esc}, {"mp", "e"}, {"", "\x1b\x1b"}, {"m", "\x1bx"}}) {
    const int armed = device.count(actuation::CoilMessage::arm);
    Terminal terminal(arguments({"--overwrite"}), at);
    let_drive(0, armed);
    terminal.press(keys);
    sleep_ms(400);
    terminal.press(emergency);
    EXPECT_EQ(terminal.wait(), 4) << keys << terminal.said();
  }
}

TEST_F(RigOperation, PastedTextIsNoCommand) {
  Terminal terminal(arguments(), at);
  let_drive(500);
  terminal.press("map,wasd\r\n\x1b[200~\x1b[24;80Rqqqpm");
  terminal.press("\xff\xfe\x80\x01\x02\x05\x06\x07");
  sleep_ms(800);
  EXPECT_TRUE(terminal.running()) << terminal.said();
  terminal.send(SIGINT);
  EXPECT_EQ(terminal.wait(), 3);
  const experiment::Record run = record();
  EXPECT_EQ(frames_in(run, NavigatorState::paused) + frames_in(run, NavigatorState::manual), 0);
}

TEST_F(RigOperation, AtTheGoalItIsHeldUntilCtrlC) {
  Terminal terminal(near_goal("1000"), at);
  EXPECT_TRUE(terminal.hears("at goal")) << terminal.said();
  sleep_ms(2000);
  EXPECT_GT(strongest, 0);  // the field goes on
  const double held = steady_seconds();
  terminal.send(SIGINT);
  EXPECT_EQ(terminal.wait(), 0) << terminal.said();
  EXPECT_GT(device.count(actuation::CoilMessage::stop), 1);
  EXPECT_LT(steady_seconds() - held, 20);
  const experiment::Record run = record();
  EXPECT_EQ(run.result.status, Status::solved);
  ASSERT_EQ(std::ranges::count(run.events, experiment::EventKind::goal_reached,
                               &experiment::RunEvent::kind),
            1);
  const double arrival = run.events.back().kind == experiment::EventKind::goal_reached
                             ? run.events.back().t
                             : run.result.metrics.time;
  EXPECT_NEAR(run.result.metrics.time, arrival, 1e-9);
  EXPECT_GT(run.frames.back().t, arrival + 1.5);
  EXPECT_LT(run.frames.back().goal_distance, 60);
  EXPECT_TRUE(names(terminal.said(), "held there for ")) << terminal.said();
}

TEST_F(RigOperation, TheHoldEndsByItsTimeOrItsKey) {
  for (const auto& [hold, key] : {std::pair{"1.5", ""}, {"1000", "q"}}) {
    Arguments words = near_goal(hold);
    words.push_back("--overwrite");
    Terminal terminal(words, at);
    EXPECT_TRUE(terminal.hears("at goal")) << terminal.said();
    terminal.press(key);
    EXPECT_EQ(terminal.wait(), 0) << terminal.said();
    EXPECT_EQ(record().result.status, Status::solved);
  }
}

TEST_F(RigOperation, WithoutHoldTheFieldGoesOffAtTheGoal) {
  Terminal terminal(near_goal("0"), at);
  EXPECT_EQ(terminal.wait(), 0) << terminal.said();
  const experiment::Record run = record();
  EXPECT_EQ(run.events.back().kind, experiment::EventKind::goal_reached);
  EXPECT_NEAR(run.events.back().t, run.frames.back().t, 0.2);
}

TEST_F(RigOperation, TheStatusLineFitsAndGoes) {
  for (const int columns : {80, 20, 200}) {
    Terminal terminal(arguments({"--overwrite"}), at, static_cast<unsigned short>(columns));
    for (int i = 0; i < 20 && !names(terminal.said(), "seen"); ++i) sleep_ms(500);
    const std::size_t from = terminal.said().size();
    sleep_ms(2000);
    const std::string live = terminal.said().substr(from);
    terminal.send(SIGINT);
    EXPECT_EQ(terminal.wait(), 3) << terminal.said();
    const auto lines = shown_lines(live);
    EXPECT_GE(lines.size(), 4u) << live;
    EXPECT_LE(lines.size(), 13u) << live;  // five a second
    for (const std::string& line : lines) {
      EXPECT_LT(width_of(line), static_cast<std::size_t>(columns)) << line;
      EXPECT_EQ(line.find(esc), std::string::npos) << line;
    }
    std::vector<std::string> parts{" s ", "seen"};
    if (columns >= 80) parts.insert(parts.end(), {"goal ", " µm", "/10 A", "/90 °C"});
    if (columns == 200) parts.insert(parts.end(), {"ms old", "p95 "});
    for (const std::string& part : parts) EXPECT_TRUE(names(lines[1], part)) << lines[1];
    // The line is gone at the end, and the result is whole.
    const std::string all = terminal.said();
    EXPECT_TRUE(names(all, "\r\x1b[Kstopped after ")) << all;
  }
}

TEST_F(RigOperation, ANoteComesAboveTheStatusLine) {
  std::atomic<int> sets = 0;
  FakeDevice trips([&, stops = 0](actuation::CoilReply& reply) mutable {
    stops += reply.to == actuation::CoilMessage::stop;  // the first ends the check before the run
    if (reply.to == actuation::CoilMessage::set && stops > 0 && ++sets == 150)
      reply.result = actuation::CoilResult::not_armed;
    return true;
  });
  Terminal terminal(arguments({"--set-rig", "driver.port=" + trips.port()}), at);
  EXPECT_TRUE(terminal.hears("armed again")) << terminal.said();
  sleep_ms(500);
  terminal.send(SIGINT);
  terminal.wait();
  EXPECT_TRUE(names(terminal.said(),
                    "\r\x1b[Knote: the coils had switched off by themselves; armed again\r\n"))
      << terminal.said();
}

TEST_F(RigOperation, AFaultInAPauseOrByHandOrAtTheGoalEndsItAsEver) {
  for (const auto& [keys, words] :
       {std::pair{"p", arguments()}, {"m", arguments()}, {"", near_goal("1000")}}) {
    std::atomic<bool> silent = false;
    FakeDevice other([&](actuation::CoilReply&) { return !silent; });
    Arguments all = words;
    all.insert(all.end(), {"--overwrite", "--set-rig", "driver.port=" + other.port()});
    Terminal terminal(all, at);
    if (std::string_view(keys).empty()) {
      EXPECT_TRUE(terminal.hears("at goal")) << terminal.said();
    } else {
      EXPECT_TRUE(terminal.hears("seen")) << terminal.said();
      terminal.press(keys);
      sleep_ms(500);
    }
    silent = true;
    EXPECT_EQ(terminal.wait(), 4) << terminal.said();
    EXPECT_TRUE(names(terminal.said(), "does not answer")) << terminal.said();
    EXPECT_TRUE(names(terminal.said(), "did not confirm")) << terminal.said();
    EXPECT_EQ(record().result.status, Status::fault);
  }
}

TEST_F(RigOperation, WithoutATerminalItSaysHowToStop) {
  Program program(arguments({"--other-stop", "--json", "--seconds", "60"}), at);
  let_drive(500);
  program.send(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "kill -INT ")) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "emergency stop of the device")) << outcome.err;
  EXPECT_EQ(outcome.err.find(esc), std::string::npos) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out).at("status"), "stopped");
}

TEST_F(RigOperation, ASuspendedComputerIsNotDrivenOn) {
  write("asleep", "0");
  at.environment = {{"LD_PRELOAD", MICROSWARM_FAKE_SUSPEND},
                    {"ASAN_OPTIONS", "verify_asan_link_order=0"},
                    {"FAKE_SUSPEND", (at.folder / "asleep").string()}};
  Program program(arguments({"--other-stop", "--seconds", "60"}), at);
  let_drive(700);
  ASSERT_TRUE(program.running());
  const int arms = device.count(actuation::CoilMessage::arm);
  write("asleep", "7");
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(names(outcome.out, "the computer was suspended for 7 s")) << outcome.out;
  EXPECT_EQ(device.count(actuation::CoilMessage::arm), arms);
  EXPECT_EQ(strongest, 0);
}

TEST_F(RigOperation, NorByHand) {
  write("asleep", "0");
  at.environment = {{"LD_PRELOAD", MICROSWARM_FAKE_SUSPEND},
                    {"ASAN_OPTIONS", "verify_asan_link_order=0"},
                    {"FAKE_SUSPEND", (at.folder / "asleep").string()}};
  Program program({"rig", "drive", "rig.yaml", "--other-stop", "--coils-cold", "--currents",
                   "2,0,0", "--seconds", "60"},
                  at);
  for (int i = 0; i < 1000 && device.count(actuation::CoilMessage::set) < 50; ++i) sleep_ms(10);
  write("asleep", "5");
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "the computer was suspended for 5 s")) << outcome.err;
  EXPECT_EQ(strongest, 0);
}

/// In the background of a terminal there are no keys either.
TEST_F(RigOperation, InTheBackgroundItIsRefused) {
  std::string line = MICROSWARM_PROGRAM;
  for (const std::string& word : arguments()) line += " " + word;
  Terminal shell("/bin/bash", {"-c", "set -m; " + line + " & wait $!; echo code $?"}, at);
  EXPECT_TRUE(shell.hears("code 2")) << shell.said();
  EXPECT_TRUE(names(shell.said(), "no terminal"));
  EXPECT_EQ(device.count(actuation::CoilMessage::arm), 0);
  EXPECT_EQ(shell.wait(), 0);
}

}  // namespace
}  // namespace microswarm::test
