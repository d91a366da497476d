// SPDX-License-Identifier: Apache-2.0
// `rig flash` with an avrdude that only says what it was asked.
#include <unistd.h>

#include "program.hpp"

namespace microswarm::test {
namespace {

class RigFlash : public CommandLine {
 protected:
  void SetUp() override {
    if (::access("/usr/bin/avr-gcc", X_OK) != 0) GTEST_SKIP() << "install gcc-avr";
    fs::create_directories(at.folder / "bin");
    program_in_path("avrdude",
                    "printf '%s ' \"$@\" > asked; pwd > source; exit ${AVRDUDE_FAILS:-0}");
    at.path = (at.folder / "bin").string() + ":/usr/bin:/bin";
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
};

TEST_F(RigFlash, BuildsTheFirmwareAndWritesIt) {
  const Outcome outcome = run({"rig", "flash", "--port", "/dev/ttyUSB7", "--out", "built", "--set",
                               "PROBES=1,1,1,0,0,0", "--set", "MAX_DEGC=90"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(names(outcome.out, "/dev/ttyUSB7")) << outcome.out;
  const std::string asked = read("asked");
  EXPECT_TRUE(names(asked, "-p atmega2560 -c wiring -P /dev/ttyUSB7")) << asked;
  EXPECT_TRUE(names(asked, (at.folder / "built/coil_driver.hex").string())) << asked;
  EXPECT_TRUE(exists("built/coil_driver.hex"));
  EXPECT_TRUE(names(read("built/settings"), "-DMAX_DEGC=90"));
}

TEST_F(RigFlash, AnInstallationHasItsOwnFirmware) {
  const fs::path source = install(at.folder / "usr");
  at.program = (at.folder / "usr/bin/microswarm").string();
  const Outcome outcome = run({"rig", "flash"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(names(outcome.out, source.string())) << outcome.out;
  EXPECT_TRUE(names(read("asked"), "-P /dev/ttyACM0")) << read("asked");
  EXPECT_FALSE(fs::exists(source / "build")) << "it may not be written to";
  // Without it, another one is not taken.
  fs::remove_all(at.folder / "usr/share/microswarm/firmware");
  refused({"rig", "flash"}, naming(source.string(), {"not there"}));
}

TEST_F(RigFlash, SaysWhatIsMissingOrWrong) {
  refused({"rig", "flash", "--set", "LIMIT=500"}, naming("--set LIMIT=500", {"LIMITS"}));
  refused({"rig", "flash", "--set", "SLEW=$(touch x)"},
          naming("--set SLEW=$(touch x)", {"4 to 255"}));
  at.environment.emplace_back("AVRDUDE_FAILS", "1");
  const Outcome failed = run({"rig", "flash"});
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

}  // namespace
}  // namespace microswarm::test
