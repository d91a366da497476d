// SPDX-License-Identifier: Apache-2.0
// Rigs driven by a program of their owner's: examples/drivers as they are, and with faults.
#include <algorithm>
#include <chrono>
#include <optional>

#include "driven_rig.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "tests/files.hpp"

namespace microswarm::test {
namespace {

class OwnDriver : public DrivenRig {
 protected:
  OwnDriver() {
    write("coils.yaml",
          "name: eight\ncoils:\n  type: matrix\n  names: [a, b, c, d, e, f, g, h]\n"
          "  field_mt_per_a:\n    - [3, -3, 0, 0, 0, 0, 2, 1]\n    - [0, 0, 3, -3, 0, 0, 1, 2]\n"
          "    - [0, 0, 0, 0, 3, -3, 1, 1]\n" +
              drives);
    write_driver();
    write_rig();
  }
  static inline const std::string drives =
      "drives:\n  - {resistance_ohm: 0.9, inductance_mh: 2.5, thermal_resistance_k_per_w: 2.5, "
      "thermal_time_s: 400, max_current_a: 10, max_voltage_v: 24, max_temperature_degc: 90}\n";

  /// The shipped example with a log of what it applies and says; `fault` may change `answer`, with
  /// `driven` as the number of answers with currents so far.
  void write_driver(const std::string& fault = "pass", const std::string& end = "pass") const {
    write("driver.py", "import os, sys, time\nsys.path.insert(0, '" MICROSWARM_SOURCE_DIR
                       "/examples/drivers')\n"
                       "sys.dont_write_bytecode = True\n"
                       "import line_driver\n"
                       "open('group', 'w').write(str(os.getpgrp()))\n"
                       "log = open('applied', 'a', buffering=1)\n"
                       "own_error, sys.stderr = sys.stderr, open('said', 'a', buffering=1)\n"
                       "driven = 0\n"
                       "def answered(*answer, flush=False, file=None):\n"
                       "    global driven\n"
                       "    if file: return print(*answer, file=file)\n"
                       "    answer = list(answer)\n"
                       "    driven += any(answer[2:])\n"
                       "    " +
                           fault +
                           "\n"
                           "    print(*answer, flush=True)\n"
                           "line_driver.print = answered\n"
                           "def apply(values): log.write(' '.join(map(str, values)) + '\\n')\n"
                           "line_driver.serve(apply)\n" +
                           end + "\n");
  }
  void write_rig(const std::string& driver = "type: program, command: [python3, driver.py]",
                 const std::string& more = "") const {
    write("rig.yaml",
          "name: bench\ncoils: coils.yaml\n"
          "field: {kind: rotating, amplitude_mt: 8, frequency_hz: 5, max_pitch_deg: 7.5}\n"
          "drive_rate_hz: 50\ndriver: {full_scale_a: 10, reply_timeout_s: 0.2, watchdog_s: 0.5, " +
              driver +
              "}\n"
              "camera: {type: simulated, microscope: {um_per_px: 6}}\n"
              "safety: {lost_swarm_s: 3, max_frame_age_s: 3, deadman_s: 3, missed_deadlines: 100, "
              "max_pause_s: 3}\n" +
              more);
  }
  std::vector<std::string> lines(const std::string& file) const {
    std::vector<std::string> all;
    if (!exists(file)) return all;
    const std::string text = read(file);
    for (const std::string_view line : split(text, '\n'))
      if (!line.empty()) all.emplace_back(line);
    return all;
  }
  static bool is_zero(const std::string& applied) {
    return std::ranges::all_of(
        words(applied), [](std::string_view word) { return word == "0.0" || word == "-0.0"; });
  }
  void expect_at_zero(std::size_t channels = 8) const {
    ASSERT_FALSE(lines("applied").empty());
    const std::string last = lines("applied").back();
    EXPECT_TRUE(is_zero(last)) << last;
    EXPECT_EQ(words(last).size(), channels);
  }
  /// Until currents were applied.
  void let_drive() const {
    for (int i = 0; i < 2000; ++i, sleep_ms(10))
      if (std::ranges::any_of(lines("applied"), [](const auto& line) { return !is_zero(line); }))
        return;
    ADD_FAILURE() << "no current";
  }
  /// Whether a process of the driver's group is left.
  bool lives() const { return ::kill(-std::stoi(read("group")), 0) == 0; }
  /// A run whose driver has this fault ends as a hardware fault that names `part`, at zero.
  void ends_with(const std::string& fault, const std::string& part, bool zero_told = true) const {
    write_driver(fault);
    const Outcome outcome = run(arguments({"--seconds", "20"}));
    EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
    const std::string said = outcome.out + outcome.err;
    EXPECT_TRUE(names(said, part)) << said;
    EXPECT_EQ(said.find('\x1b'), std::string::npos);
    EXPECT_EQ(!names(outcome.err, "did not confirm"), zero_told) << outcome.err;
    EXPECT_FALSE(lives());
  }
};

bool says_no_more_than_usual(const std::string& err) {
  return err.starts_with("note: commissioning: never measured") && names(err, "\nto stop") &&
         std::ranges::count(err, '\n') == 2;
}

TEST_F(OwnDriver, ChecksDrivesAndRunsEightAndSixteenChannels) {
  for (const std::string& channels : {std::string(), std::string("16")}) {
    const std::size_t count = channels.empty() ? 8 : 16;
    write_rig("type: program, command: [python3, driver.py]" +
              (channels.empty() ? "" : ", channels: " + channels));
    const Outcome check = run({"rig", "check", "rig.yaml", "--seconds", "0.5"});
    EXPECT_EQ(check.code, 0) << check.out << check.err;
    EXPECT_TRUE(names(check.out, "coils     eight: 8 coils")) << check.out;
    const Outcome drive = run({"rig", "drive", "rig.yaml", "--field", "2,0,0", "--seconds", "1",
                               "--other-stop", "--coils-cold"});
    EXPECT_EQ(drive.code, 0) << drive.err;
    const Outcome outcome = run(arguments({"--seconds", "2", "--out", "out" + channels}));
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_TRUE(says_no_more_than_usual(outcome.err)) << outcome.err;
    const std::vector<std::string> applied = lines("applied");
    EXPECT_GT(std::ranges::count_if(applied, [](const auto& line) { return !is_zero(line); }), 50);
    expect_at_zero(count);
    EXPECT_TRUE(names(lines("said").back(), "off"));
    EXPECT_FALSE(lives());
    fs::remove(at.folder / "applied");
  }
}

TEST_F(OwnDriver, TheShippedOctoMagCalibrationRuns) {
  const char* const data = std::getenv("MICROSWARM_DATA");
  if (!data) GTEST_SKIP() << "MICROSWARM_DATA names no folder";
  fs::copy(fs::path(data) / "magcal/OctoMag_Calibration.yaml", at.folder);
  write("coils.yaml", "coils: {type: mpem, file: OctoMag_Calibration.yaml}\n" + drives);
  for (const char* channels : {"8", "16"}) {
    const std::string setting = std::string("driver.channels=") + channels;
    const Outcome check = run({"rig", "check", "rig.yaml", "--seconds", "0.5", "--set", setting});
    EXPECT_EQ(check.code, 0) << check.out;
    const Outcome drive = run({"rig", "drive", "rig.yaml", "--field", "2,0,0", "--seconds", "1",
                               "--other-stop", "--coils-cold", "--set", setting});
    EXPECT_EQ(drive.code, 0) << drive.err;
    EXPECT_EQ(run(arguments({"--seconds", "2", "--set-rig", setting})).code, 3);
    expect_at_zero(static_cast<std::size_t>(std::stoi(channels)));
  }
}

TEST_F(OwnDriver, AFieldIsSentAfterTheLimitsOfTheCoils) {
  write_rig("type: program, command: [python3, driver.py], send: field");
  EXPECT_EQ(run({"rig", "drive", "rig.yaml", "--field", "3,0,-1", "--seconds", "1.5", "--ramp",
                 "0.2", "--other-stop", "--coils-cold"})
                .code,
            0);
  expect_at_zero(3);
  const std::vector<std::string> applied = lines("applied");
  EXPECT_GT(std::ranges::count(applied, "3.0 0.0 -1.0"), 10);
  // 40 mT need more than the coils' 10 A: the field is weaker, in the same direction.
  fs::remove(at.folder / "applied");
  EXPECT_EQ(run({"rig", "drive", "rig.yaml", "--field", "90,0,0", "--seconds", "1.5", "--ramp",
                 "0.2", "--other-stop", "--coils-cold"})
                .code,
            0);
  double most = 0;
  for (const std::string& line : lines("applied")) {
    most = std::max(most, std::stod(std::string(words(line)[0])));
    EXPECT_NEAR(std::stod(std::string(words(line)[1])), 0, 1e-5);
  }
  EXPECT_GT(most, 30);
  EXPECT_LT(most, 85);
  const Outcome currents = run({"rig", "drive", "rig.yaml", "--currents", "1,0,0,0,0,0,0,0",
                                "--other-stop", "--coils-cold"});
  EXPECT_EQ(currents.code, 2);
  EXPECT_TRUE(names(currents.err, "--field")) << currents.err;
  EXPECT_EQ(run(arguments({"--seconds", "1.5"})).code, 3);
}

TEST_F(OwnDriver, OneThatDiesEndsTheRunWithItsLastWords) {
  ends_with(
      "if driven == 30: own_error.write('\\x1b[2Jerror -200284\\n'), own_error.flush(), "
      "os._exit(7)",
      "has ended with exit code 7; its last words: ?[2Jerror -200284");
}

TEST_F(OwnDriver, ABugInItTurnsOffByItself) {
  ends_with("if driven == 30: raise ValueError('no card')", "has ended with exit code 1");
  expect_at_zero();
}

TEST_F(OwnDriver, ASilentOneEndsTheRun) {
  ends_with("if driven >= 30 and any(answer[2:]): return",
            "does not answer: nothing came back, messages sent: 3");
  expect_at_zero();
}

TEST_F(OwnDriver, OneThatIsSilentForEverEndsTheRunAndIsKilled) {
  ends_with("if driven == 30: time.sleep(1000)",
            "does not answer: nothing came back, messages sent: 3");
}

TEST_F(OwnDriver, GarbageEndsTheRunAndIsNotPrintedRaw) {
  ends_with(
      "if driven >= 30 and any(answer[2:]): return print('\\x1b[2J\\x07' + 'x' * 9, flush=True)",
      "it said '?[2J?xxxxxxxxx'");
  ends_with("if driven >= 30 and any(answer[2:]): return print('x' * 99999, flush=True)",
            "does not answer: it floods the line");
}

TEST_F(OwnDriver, LiesAboutItsValuesEndTheRun) {
  ends_with("if driven >= 30 and any(answer[2:]): answer[2] += 0.5",
            "reports other values than those sent");
  ends_with("if driven >= 30 and any(answer[2:]): answer[2] = float('nan')",
            "acknowledged no numbers");
}

TEST_F(OwnDriver, OneThatIsOffAgainAndAgainEndsTheRun) {
  ends_with("if driven % 30 == 29 and any(answer[2:]): answer = ['off', answer[1], 'overload']",
            "off by themselves 2 times in 10 s, allowed 1");
}

TEST_F(OwnDriver, ARefusedArmAndAnEmergencyStopAreTold) {
  ends_with("if answer[1] == 2: answer = ['refused', 2, 'interlock open']",
            "does not let itself be armed: interlock open");
  EXPECT_TRUE(std::ranges::all_of(lines("applied"), is_zero));
  EXPECT_EQ(run(arguments({"--out", "out"})).code, 4);
  EXPECT_FALSE(exists("out"));  // nothing was driven
  ends_with("if driven >= 30 and any(answer[2:]): answer = ['emergency', answer[1]]",
            "the emergency stop of the coils' device was pressed");
}

/// A stop that is not answered: the process is killed, and a second one says zero.
TEST_F(OwnDriver, OneThatNeverAnswersStopIsRefusedBeforeItDrives) {
  const std::string hangs =
      "if sys._getframe(1).f_locals['message'][0] == b'stop': time.sleep(1000)";
  write_driver(hangs);
  const std::string reason = "did not answer stop; it was ended, and a second one said zero";
  const Outcome check = run({"rig", "check", "rig.yaml", "--seconds", "0.5"});
  EXPECT_EQ(check.code, 4) << check.out;
  EXPECT_TRUE(names(check.out, "NO   stop      " + reason)) << check.out;
  ends_with(hangs, "stop: " + reason);
  EXPECT_TRUE(std::ranges::all_of(lines("applied"), is_zero));
  const Outcome drive = run({"rig", "drive", "rig.yaml", "--field", "2,0,0", "--seconds", "1",
                             "--other-stop", "--coils-cold"});
  EXPECT_EQ(drive.code, 4) << drive.err;
  EXPECT_TRUE(names(drive.err, reason)) << drive.err;
  EXPECT_FALSE(lives());
}

TEST_F(OwnDriver, OneThatDoesNotSayZeroAtTheStopOfARunIsTold) {
  for (const auto& [fault, trouble] : std::vector<std::pair<std::string, std::string>>{
           {"time.sleep(1000)", "did not answer stop; it was ended"},
           {"answer = ['refused', answer[1], 'busy']", "did not say zero to stop; it was ended"}}) {
    write_driver("if driven and sys._getframe(1).f_locals['message'][0] == b'stop': " + fault);
    const Outcome outcome = run(arguments({"--seconds", "1.5"}));
    EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
    EXPECT_TRUE(names(outcome.err, trouble + ", and a second one said zero")) << outcome.err;
    expect_at_zero();
  }
}

/// Its acknowledged values are `share` of those sent.
std::string weak(const std::string& share) {
  return "if any(answer[2:]): answer = ['limited', answer[1]] + [" + share +
         " * v for v in answer[2:]]";
}

TEST_F(OwnDriver, WhatItsLimitsLeaveIsTold) {
  write_driver(weak("0.5"));
  const Outcome drive = run({"rig", "drive", "rig.yaml", "--currents", "4,0,0,0,0,0,0,0",
                             "--seconds", "1", "--ramp", "0.2", "--other-stop", "--coils-cold"});
  EXPECT_EQ(drive.code, 0) << drive.err;
  EXPECT_TRUE(names(drive.err,
                    "the device weakened the currents to 50 %: at most 2, 0, 0, 0, 0, 0, 0, 0 A, "
                    "(6, 0, 0) mT more at the centre"))
      << drive.err;
  const Outcome outcome = run(arguments({"--seconds", "1.5", "--out", "out"}));
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "the device weakened the currents")) << outcome.err;
  const std::vector<std::string> rows = lines("out/commands.csv");
  const experiment::RigLog log = experiment::read_record(at.folder / "out/run.h5").rig_log;
  ASSERT_EQ(rows.size(), log.driven_at.size() + 2);
  EXPECT_TRUE(names(rows[0], "i_h_a,scale,device_scale,status"));
  const auto cells = split(rows[20], ',');
  EXPECT_EQ(cells[15], "0.5") << rows[20];
  for (std::size_t c = 0; c < 8; ++c)
    EXPECT_NEAR(log.currents[19 * 8 + c], std::stod(std::string(cells[6 + c])) / 2, 1e-4);
}

TEST_F(OwnDriver, OneThatDrivesNoCurrentIsAFault) {
  write_driver(weak("0"));
  const Outcome drive = run({"rig", "drive", "rig.yaml", "--field", "2,0,0", "--seconds", "9",
                             "--other-stop", "--coils-cold"});
  EXPECT_EQ(drive.code, 4) << drive.err;
  EXPECT_TRUE(names(drive.err, "the device drives no current")) << drive.err;
  ends_with(weak("0"), "the device drives no current");
  ends_with(weak("0.05"), "the device drives 5 % of the currents");
}

TEST_F(OwnDriver, OneThatHangsAtTheEndIsKilledAfterTheStop) {
  write_driver("pass", "import signal\nsignal.signal(15, signal.SIG_IGN)\ntime.sleep(1000)");
  const Outcome outcome = run(arguments({"--seconds", "1.5"}));
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_TRUE(says_no_more_than_usual(outcome.err)) << outcome.err;
  EXPECT_FALSE(lives());
  expect_at_zero();
}

TEST_F(OwnDriver, AKilledHostTurnsItOff) {
  Program program(arguments(), at);
  let_drive();
  program.send(SIGKILL);
  EXPECT_EQ(program.wait().signal, SIGKILL);
  const auto began = std::chrono::steady_clock::now();
  while (lives() && std::chrono::steady_clock::now() - began < std::chrono::seconds(5)) sleep_ms(1);
  EXPECT_FALSE(lives());
  expect_at_zero();
  EXPECT_TRUE(names(lines("said").back(), "the host has gone")) << lines("said").back();
}

TEST_F(OwnDriver, AStoppedHostTripsIt) {
  Program program(arguments(), at);
  let_drive();
  program.send(SIGSTOP);
  sleep_ms(1500);
  expect_at_zero();
  EXPECT_TRUE(names(lines("said").back(), "in time: off")) << lines("said").back();
  program.send(SIGCONT);
  program.send(SIGTERM);
  const int code = program.wait().code;
  EXPECT_TRUE(code == 3 || code == 4) << code;  // it notices the signal or the device first
}

TEST_F(OwnDriver, CoilsHaveOneHost) {
  Program program(arguments(), at);
  let_drive();
  const Outcome second =
      run({"rig", "drive", "rig.yaml", "--field", "1,0,0", "--other-stop", "--coils-cold"});
  EXPECT_EQ(second.code, 4);
  EXPECT_TRUE(names(second.err, "coils.yaml: another program drives these coils")) << second.err;
  // A copy of the coil file has the same driver.
  fs::copy(at.folder / "coils.yaml", at.folder / "copy.yaml");
  const Outcome copy = run({"rig", "drive", "rig.yaml", "--field", "1,0,0", "--other-stop",
                            "--coils-cold", "--set", "coils=copy.yaml"});
  EXPECT_EQ(copy.code, 4);
  EXPECT_TRUE(names(copy.err, "python3 driver.py: another program drives")) << copy.err;
  program.send(SIGTERM);
  EXPECT_EQ(program.wait().code, 3);
}

TEST_F(OwnDriver, NothingIsStartedWithoutADevice) {
  write_rig("type: program, command: [touch, started]");
  EXPECT_EQ(run(arguments({"--seconds", "1", "--dry-run"})).code, 3);
  EXPECT_NE(run({"run", "flight.yaml", "--rig", "rig.yaml"}).code, 2);
  EXPECT_NE(run({"rig", "simulate", "flight.yaml", "--rig", "rig.yaml"}).code, 2);
  EXPECT_EQ(run({"rig", "run", "flight.yaml", "--rig", "rig.yaml", "--other-stop"}).code, 2);
  write("coils.yaml", read("coils.yaml").substr(0, read("coils.yaml").find("drives")));
  EXPECT_EQ(run(arguments()).code, 2);
  EXPECT_FALSE(exists("started"));
}

TEST_F(OwnDriver, KeysAreStrict) {
  const std::string program = "type: program, command: [python3, driver.py]";
  const Outcome few = run({"rig", "check", "rig.yaml", "--set", "driver.channels=6"});
  EXPECT_TRUE(names(few.err, "the system has 8 coils, the driver 6 channels")) << few.err;
  EXPECT_EQ(few.code, 2);
  for (const auto& [driver, part] : std::vector<std::pair<std::string, std::string>>{
           {"type: program", "command"},
           {"type: program, command: []", "empty"},
           {program + ", shell: true", "shell"},
           {program + ", channels: 65", "64"},
           {program + ", send: voltages", "send"},
           {program + ", send: field, channels: 3", "field"},
           {"type: socket, port: 0", "65535"},
           {"type: socket, command: [x]", "command"},
           {"type: programme, command: [x]", "program"}}) {
    write_rig(driver);
    const Outcome outcome = run({"rig", "check", "rig.yaml"});
    EXPECT_EQ(outcome.code, 2) << driver;
    EXPECT_TRUE(names(outcome.err, "rig.yaml:5:") && names(outcome.err, part)) << outcome.err;
  }
  write_rig(program);
  const Outcome hasty = run({"rig", "check", "rig.yaml", "--set", "driver.watchdog_s=0.03"});
  EXPECT_EQ(hasty.code, 2);
  EXPECT_TRUE(names(hasty.err, "watchdog_s")) << hasty.err;
}

TEST_F(OwnDriver, TheFewLinesOfItsPageAreADriver) {
  const std::string page = read_file(MICROSWARM_SOURCE_DIR "/docs/reference/line-protocol.md");
  const std::size_t begin = page.find("```python\n") + 10;
  std::string code = page.substr(begin, page.find("```", begin) - begin);
  const std::size_t nothing = code.find("lambda values: None");
  ASSERT_NE(nothing, std::string::npos);
  code.replace(nothing, 19, "lambda values: print(*values, file=log)");
  write("driver.py", "log = open('applied', 'a', buffering=1)\n" + code);
  EXPECT_EQ(run({"rig", "check", "rig.yaml", "--seconds", "0.5"}).code, 0);
  EXPECT_EQ(run(arguments({"--seconds", "2"})).code, 3);
  EXPECT_GT(lines("applied").size(), 50u);
  expect_at_zero();
  Program program(arguments(), at);
  let_drive();
  program.send(SIGSTOP);
  sleep_ms(1500);
  expect_at_zero();
  program.send(SIGKILL);
  program.wait();
  sleep_ms(300);
  expect_at_zero();
}

/// Octave with its package instrument-control stands in for MATLAB.
TEST_F(OwnDriver, TheServerForMatlabRunsInOctave) {
  if (std::system("octave-cli --eval 'pkg load instrument-control; which tcpserver' 2>/dev/null | "
                  "grep -q tcpserver") != 0)
    GTEST_SKIP() << "no Octave with instrument-control";
  const std::string port = std::to_string(20000 + ::getpid() % 20000);
  write("serve.m", "pkg load instrument-control\naddpath('" MICROSWARM_SOURCE_DIR
                   "/examples/drivers')\nglobal file\nfile = fopen('applied', 'w');\n"
                   "function note(values)\n  global file\n  fprintf(file, '%.1f ', values);\n"
                   "  fprintf(file, '\\n'); fflush(file);\nend\ncoil_server(" +
                       port + ", @note)\n");
  const pid_t octave = ::fork();
  if (octave == 0) {
    if (::chdir(at.folder.c_str()) == 0)
      ::execlp("octave-cli", "octave-cli", "--quiet", "serve.m", nullptr);
    ::_exit(127);
  }
  write_rig("type: socket, port: " + port);
  Outcome outcome;
  for (int k = 0; k < 100; ++k, sleep_ms(200)) {
    outcome = run(arguments({"--seconds", "2", "--set-rig", "driver.watchdog_s=1"}));
    if (!names(outcome.err, "cannot connect")) break;
  }
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_GT(lines("applied").size(), 40u);
  EXPECT_TRUE(
      std::ranges::any_of(lines("applied"), [](const auto& line) { return !is_zero(line); }));
  const std::string last = lines("applied").back();
  for (const std::string_view value : words(last)) EXPECT_TRUE(value == "0.0") << last;
  ::kill(octave, SIGKILL);
  int status = 0;
  ::waitpid(octave, &status, 0);
}

}  // namespace
}  // namespace microswarm::test
