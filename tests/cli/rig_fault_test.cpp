// SPDX-License-Identifier: Apache-2.0
// The command that a rig's file starts when a run ends with a fault.
#include <chrono>

#include "driven_rig.hpp"
#include "microswarm/experiment/record/record.hpp"

namespace microswarm::test {
namespace {

class RigFault : public DrivenRig {
 protected:
  RigFault() { write_rig(device); }
  /// Writes the command, which the rig's file names by a path beside it.
  void write_command(const std::string& script) const {
    write("told.sh", "#!/bin/sh\n" + script);
    fs::permissions(at.folder / "told.sh", fs::perms::owner_all);
  }
  /// A run that stands still for longer than is allowed, and has this command.
  Outcome stands_still(const std::string& command) {
    Program program(
        arguments({"--seconds", "15", "--out", "out", "--set-rig", "safety.max_pause_s=0.3",
                   "--set-rig", "safety.on_fault=" + command}),
        at);
    let_drive(device, 500);
    program.send(SIGSTOP);
    sleep_ms(600);
    program.send(SIGCONT);
    return program.wait();
  }
  FakeDevice device;
};

TEST_F(RigFault, ItsCommandIsToldAfterTheCoilsAreAtZero) {
  write_command(
      "printf '%s\\n' \"$MICROSWARM_FAULT\" >reason\nprintf '%s\\n' \"$MICROSWARM_RECORD\" "
      ">record\n"
      "printf '%s\\n' \"$1\" >word\ntail -n 1 out/commands.csv >last\n"
      "ps -o pgid= -p $$ >group\necho $$ >own\nls /proc/self/fd >files\n");
  const Outcome outcome = stands_still("[./told.sh, \"a $HOME; b\"]");
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  ASSERT_TRUE(exists("files")) << outcome.err;
  EXPECT_TRUE(is_one_line_naming(read("reason"), "", {"stood still"})) << read("reason");
  EXPECT_EQ(read("record"), fs::canonical(at.folder / "out").string() + "\n");
  EXPECT_EQ(read("word"), "a $HOME; b\n");  // no shell
  EXPECT_TRUE(names(read("last"), "zero")) << read("last");
  EXPECT_EQ(std::stoi(read("group")), std::stoi(read("own")));
  EXPECT_EQ(read("files"), "0\n1\n2\n3\n");  // 3 is the folder that ls reads
  EXPECT_FALSE(names(outcome.err, "on_fault")) << outcome.err;
}

TEST_F(RigFault, WhatItsCommandSaysIsNoResult) {
  write_command("echo written\n");
  const Outcome outcome = stands_still("[./told.sh]");
  EXPECT_FALSE(names(outcome.out, "written")) << outcome.out;
  EXPECT_TRUE(names(outcome.err, "written")) << outcome.err;
}

TEST_F(RigFault, ACommandThatFailsIsANote) {
  write_command("exit 7\n");
  const Outcome outcome = stands_still("[./told.sh]");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(names(outcome.err, "note: safety.on_fault: ./told.sh ended with exit code 7"))
      << outcome.err;
}

TEST_F(RigFault, ACommandThatDoesNotExistIsANote) {
  const Outcome outcome = stands_still("[./none.sh]");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(names(outcome.err, "note: safety.on_fault: ./none.sh cannot be started: "))
      << outcome.err;
}

TEST_F(RigFault, ACommandThatHangsDelaysNeitherZeroNorRecordAndIsEnded) {
  write_command("echo $$ >own\ntrap '' TERM\nsleep 100 &\nwait\nsleep 100\n");
  const Outcome outcome = stands_still("[./told.sh]");
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "did not end within 10 s")) << outcome.err;
  ASSERT_TRUE(exists("own"));
  const auto lives = [this] { return ::kill(-std::stoi(read("own")), 0) == 0; };
  for (int i = 0; i < 500 && lives(); ++i) sleep_ms(10);  // until its orphan is reaped
  EXPECT_FALSE(lives());
  const auto after = [this](const char* file) {
    return std::chrono::duration<double>(fs::last_write_time(at.folder / file) -
                                         fs::last_write_time(at.folder / "own"))
        .count();
  };
  EXPECT_LT(after("out/run.h5"), 5);
  EXPECT_LT(after("out/commands.csv"), 5);
}

TEST_F(RigFault, AnUnconfirmedZeroIsTold) {
  FakeDevice unsure([stops = 0](actuation::CoilReply& reply) mutable {
    // The first stop ends the check before the run.
    if (reply.to == actuation::CoilMessage::stop && ++stops > 1) reply.outputs[0] = 300;
    return true;
  });
  write_rig(unsure);
  write_command("printf '%s\\n' \"$MICROSWARM_FAULT\" \"$MICROSWARM_RECORD\" >reason\n");
  const Outcome outcome =
      run(arguments({"--seconds", "1.5", "--set-rig", "safety.on_fault=[./told.sh]"}));
  EXPECT_EQ(outcome.code, 4);
  ASSERT_TRUE(exists("reason")) << outcome.err;
  EXPECT_TRUE(names(read("reason"), "did not confirm")) << read("reason");
  EXPECT_TRUE(read("reason").ends_with("\n\n")) << "there is no record";
}

TEST_F(RigFault, AnEndInOrderStartsNoCommand) {
  write_command("echo >told\n");
  EXPECT_EQ(run(arguments({"--seconds", "1.5", "--set-rig", "safety.on_fault=[./told.sh]"})).code,
            3);
  EXPECT_FALSE(exists("told"));
}

TEST_F(RigFault, AnEmptyCommandIsRefused) {
  refused(arguments({"--set-rig", "safety.on_fault=['']"}),
          naming("--set-rig safety.on_fault", {"empty"}));
}

}  // namespace
}  // namespace microswarm::test
