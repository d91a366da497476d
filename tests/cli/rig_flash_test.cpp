// SPDX-License-Identifier: Apache-2.0
// `rig flash` with an avrdude that only says what it was asked.
#include <pty.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <chrono>

#include "program.hpp"

namespace microswarm::test {
namespace {

/// A pseudo-terminal in place of a board.
struct SerialLine {
  SerialLine() {
    std::array<char, 64> name{};
    if (openpty(&ours, &other, name.data(), nullptr, nullptr) != 0) ADD_FAILURE() << "no pty";
    port = name.data();
  }
  ~SerialLine() {
    ::close(ours);
    ::close(other);
  }
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  int ours = -1, other = -1;
  std::string port;
};

class RigFlash : public CommandLine {
 protected:
  void SetUp() override {
    if (::access("/usr/bin/avr-gcc", X_OK) != 0) GTEST_SKIP() << "install gcc-avr";
    fs::create_directories(at.folder / "bin");
    program_in_path("avrdude", "printf '%s ' \"$@\" > asked");
    at.path = (at.folder / "bin").string() + ":/usr/bin:/bin";
  }
  Arguments flash(const Arguments& more = {}) const {
    Arguments all{"rig", "flash", "--port", line.port};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// Not written, for one reason: a line that names the port, and exit code 4.
  void not_written(const std::string& port, const std::string& why) const {
    const Outcome outcome = run({"rig", "flash", "--port", port});
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_TRUE(is_one_line_naming(outcome.err, "microswarm: " + port, {why})) << outcome.err;
    EXPECT_FALSE(exists("asked"));
  }
  void program_in_path(const std::string& name, const std::string& script) const {
    write("bin/" + name, "#!/bin/sh\ncd '" + at.folder.string() + "'\n" + script + "\n");
    fs::permissions(at.folder / "bin" / name, fs::perms::owner_all);
  }
  /// An installation that holds the program, a link to the scenarios and the firmware.
  fs::path install(const fs::path& prefix) const {
    const fs::path source = MICROSWARM_SOURCE_DIR;
    fs::create_directories(prefix / "bin");
    fs::create_directories(prefix / "share/microswarm/scenarios");
    std::error_code across;  // of file systems
    fs::create_hard_link(MICROSWARM_PROGRAM, prefix / "bin/microswarm", across);
    if (across) fs::copy_file(MICROSWARM_PROGRAM, prefix / "bin/microswarm");
    fs::copy(source / "firmware", prefix / "share/microswarm/firmware",
             fs::copy_options::recursive);
    return prefix / "share/microswarm/firmware/coil_driver";
  }

  SerialLine line;
};

TEST_F(RigFlash, BuildsTheFirmwareAndWritesIt) {
  const Outcome outcome = run(
      flash({"--out", "built in a lab", "--set", "PROBES=1,1,1,0,0,0", "--set", "MAX_DEGC=90"}));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(names(outcome.out, line.port)) << outcome.out;
  const std::string asked = read("asked");
  EXPECT_TRUE(names(asked, "-p atmega2560 -c wiring -P " + line.port)) << asked;
  EXPECT_TRUE(names(asked, "flash:w:build/coil_driver.hex:i")) << asked;
  EXPECT_TRUE(exists("built in a lab/coil_driver.hex"));
  EXPECT_TRUE(names(outcome.out, "with PROBES=1,1,1,0,0,0 MAX_DEGC=90")) << outcome.out;
  EXPECT_TRUE(exists("built in a lab/coil_driver.elf"));
  EXPECT_TRUE(names(read("built in a lab/settings"), "-DMAX_DEGC=90"));
}

TEST_F(RigFlash, AnInstallationHasItsOwnFirmware) {
  const fs::path source = install(at.folder / "usr");
  at.program = (at.folder / "usr/bin/microswarm").string();
  const Outcome outcome = run(flash());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(names(outcome.out, source.string())) << outcome.out;
  EXPECT_TRUE(names(outcome.out, "with the default settings")) << outcome.out;
  EXPECT_FALSE(fs::exists(source / "build")) << "it may not be written to";
  // Without it, another one is not taken.
  fs::remove_all(at.folder / "usr/share/microswarm/firmware");
  refused({"rig", "flash"}, naming(source.string(), {"not there"}));
}

TEST_F(RigFlash, SaysWhatIsMissingOrWrong) {
  refused({"rig", "flash", "--set", "LIMIT=500"}, naming("--set LIMIT=500", {"LIMITS"}));
  refused({"rig", "flash", "--set", "SLEW=$(touch x)"},
          naming("--set SLEW=$(touch x)", {"4 to 255"}));
  program_in_path("avrdude", "exit 1");
  const Outcome failed = run(flash());
  EXPECT_EQ(failed.code, 4) << failed.err;
  EXPECT_TRUE(names(failed.err, "the firmware was not written")) << failed.err;
  const Outcome wrong = run({"rig", "flash", "--build-only", "--set", "MAX_DEGC=90"});
  EXPECT_EQ(wrong.code, 2) << wrong.err;
  EXPECT_TRUE(names(wrong.err, "MAX_DEGC needs PROBES")) << wrong.err;
  at.path = (at.folder / "bin").string();
  refused({"rig", "flash"}, naming("", {"make, avr-gcc", "apt install"}));
}

TEST_F(RigFlash, TakesOnlyValuesThatTheFirmwareIsMadeFor) {
  const auto refuses = [&](const std::string& setting, const std::string& limit) {
    refused({"rig", "flash", "--set", setting}, naming("--set " + setting, {limit}));
  };
  for (const char* limits : {"-800,1000,1000,1000,1000,1000", "8000,1,1,1,1,1", "800",
                             "075,1,1,1,1,1", "1,1,1,1,1,1,1", "1,1,1,1,1,", "0x10,1,1,1,1,1", "",
                             "+1,1,1,1,1,1", "99999999999,1,1,1,1,1", "1, 1,1,1,1,1"})
    refuses(std::string("LIMITS=") + limits, "6 whole numbers of 0 to 1000");
  for (const char* degc : {"80-10", "075", "241", "-1", "90.5"})
    refuses(std::string("MAX_DEGC=") + degc, "0 to 240");
  refuses("PROBES=1,1,2,0,0,0", "0 to 1");
  refuses("PROBE_OHMS=499", "500 to 6000");
  refuses("SLEW=3", "4 to 255");
  refuses("SLEW", "KEY=VALUE");
  refuses("EMERGENCY_STOP=None", "must be none");
  refused({"rig", "flash", "--set", "SLEW=50", "--set", "SLEW=60"},
          naming("--set SLEW=60", {"twice"}));
}

TEST_F(RigFlash, TakesNoSettingFromTheEnvironment) {
  const auto build = [&](const std::string& out) {
    const Outcome outcome = run({"rig", "flash", "--build-only", "--out", out});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  };
  build("plain");
  for (const auto& [name, value] : {std::pair{"CFLAGS", "-DNO_EMERGENCY_STOP -march=native"},
                                    {"LIMITS", "800,1,1,1,1,1"},
                                    {"EMERGENCY_STOP", "none"},
                                    {"MAKEFLAGS", "SLEW=50"},
                                    {"MAKEFLAGS", "-n"}})
    at.environment.emplace_back(name, value);
  build("again");
  EXPECT_EQ(read("again/coil_driver.hex"), read("plain/coil_driver.hex"));
  EXPECT_EQ(read("again/settings"), read("plain/settings"));
}

TEST_F(RigFlash, LooksAtThePortFirst) {
  not_written("/dev/nope", "No such file");
  not_written("/dev/null", "serial port");
  write("file", "");
  not_written((at.folder / "file").string(), "serial port");
  ::flock(line.other, LOCK_EX);
  not_written(line.port, "another program");
}

TEST_F(RigFlash, EndsAWriterThatDoesNotEnd) {
  program_in_path("avrdude", "trap '' TERM; echo begun > asked; while :; do sleep 0.1; done");
  const auto began = std::chrono::steady_clock::now();
  const Outcome outcome = run(flash({"--timeout", "1.5"}));
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(40));
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(exists("asked"));
  EXPECT_TRUE(names(outcome.err, line.port + ": the firmware was not written within 1.5 s"))
      << outcome.err;
}

}  // namespace
}  // namespace microswarm::test
