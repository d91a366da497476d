// SPDX-License-Identifier: Apache-2.0
// The line driver with programs, which are scripts of the shell.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/text/file.hpp"
#include "tests/actuation/line_drivers.hpp"
#include "tests/files.hpp"

namespace microswarm::actuation {
namespace {

/// A program of the shell that does `then` with the word, number and rest of each message.
class LineProgram : public testing::Test {
 protected:
  std::unique_ptr<LineCoilDriver> start(const std::string& script,
                                        const LineDriverParams& p = quick(),
                                        std::unique_ptr<DeviceLock> lock = nullptr) {
    const std::vector<int> locks = lock ? lock->descriptors() : std::vector<int>();
    return std::make_unique<LineCoilDriver>(
        [=, this](double) {
          return start_program({"sh", "-c", "echo $$ >pid; " + script}, folder_ / ".", locks);
        },
        p, 3, std::move(lock));
  }
  static std::string answering(const std::string& set) {
    return "while read word n rest; do case $word in set) " + set +
           ";; *) echo ok $n 0 0 0;; esac; done";
  }
  /// Whether a process of the program's group is left.
  bool lives() const {
    const int group = std::stoi(read_file(folder_ / "pid"));
    return ::kill(-group, 0) == 0;
  }
  test::Folder folder_;
};

TEST_F(LineProgram, IsStartedInItsFolderAndGoneInTheEnd) {
  {
    const auto driver = start(answering("echo ok $n $rest"));
    EXPECT_EQ(driver->drive(amperes), DriveStatus::driven);
    EXPECT_TRUE(lives());
    EXPECT_NE(::getpgid(std::stoi(read_file(folder_ / "pid"))), ::getpgrp());
  }
  EXPECT_FALSE(lives());
}

TEST_F(LineProgram, ItsEndIsToldWithItsLastWords) {
  const auto ended = [&](const std::string& how, const std::string& reason) {
    const auto driver = start(answering(how));
    const double began = steady_seconds();
    EXPECT_EQ(driver->drive(amperes), DriveStatus::gone);
    EXPECT_LT(steady_seconds() - began, 0.25);
    EXPECT_TRUE(test::names(driver->report().reason, reason)) << driver->report().reason;
    EXPECT_TRUE(driver->stop().confirmed);  // by another one, which drives nothing
    EXPECT_EQ(driver->drive(amperes), DriveStatus::gone);
    EXPECT_TRUE(test::names(driver->report().reason, reason)) << driver->report().reason;
    EXPECT_TRUE(driver->stop().confirmed);
  };
  ended("printf 'Traceback\\n\\033[2Jno card\\n' >&2; exit 7",
        "has ended with exit code 7; its last words: ?[2Jno card");
  ended("printf 'no end' >&2; kill -9 $$", "was ended by signal 9");
  ended("exec >&-; sleep 1", "has closed its output");
}

TEST_F(LineProgram, WhatCannotBeStartedOrEndsAtOnceIsNamed) {
  refuses(
      [&] {
        start_program({"./none", "x"}, folder_ / ".");
      },
      "./none x", {"cannot be started"});
  refuses([&] { start_program({"true"}, folder_ / "none"); }, "true", {"cannot be started"});
  refuses([&] { start("echo no nidaqmx >&2; exit 1"); }, "",
          {"exit code 1; its last words: no nidaqmx"});
}

TEST_F(LineProgram, NeitherAFullPipeNorAFloodOfErrorsBlocks) {
  LineDriverParams p = quick();
  p.channels = 64;
  p.reply_timeout = 0.02;
  const auto deaf = start(
      "z=$(yes 0 | head -64); for k in 1 2; do read word n rest; echo ok $n $z; done; exec sleep "
      "99",
      p);
  const std::vector<double> many(64, 1.0);
  double longest = 0;
  for (int k = 0; k < 120; ++k) {  // 77 kB
    const double began = steady_seconds();
    EXPECT_EQ(deaf->drive(many), DriveStatus::no_answer);
    longest = std::max(longest, steady_seconds() - began);
  }
  EXPECT_LT(longest, 0.3);
  EXPECT_EQ(deaf->report().reason, "it accepts no bytes");
  const auto loud =
      start(answering("head -c 1000000 /dev/zero | tr '\\0' x >&2; echo ok $n $rest"));
  EXPECT_EQ(loud->drive(amperes), DriveStatus::driven);
}

TEST_F(LineProgram, AStopThatIsNotAnsweredBeginsOnceMore) {
  const std::string script =
      "echo one >>begun; while read word n rest; do case $word in stop) exec sleep 99;; "
      "set) echo ok $n $rest;; *) echo ok $n 0 0 0;; esac; done";
  {
    const auto driver = start(script);
    EXPECT_EQ(driver->drive(amperes), DriveStatus::driven);
    const StopReport zero = driver->stop();
    EXPECT_TRUE(zero.confirmed);
    EXPECT_EQ(zero.trouble, "did not answer stop; it was ended, and a second one said zero");
    EXPECT_EQ(driver->report().currents[1], 0);
    EXPECT_EQ(driver->drive(amperes), DriveStatus::gone);
  }
  EXPECT_EQ(read_file(folder_ / "begun"), "one\none\n");
  EXPECT_FALSE(lives());
}

/// A card holds its current until the second one says zero: no patience after three misses.
TEST_F(LineProgram, OneThatHangsOrFloodsInARunIsKilledAtOnce) {
  LineDriverParams p = quick();
  p.reply_timeout = 0.05;
  for (const char* fault : {"sleep 99", "tr '\\0' x </dev/zero"}) {
    const auto driver = start(std::string("trap '' TERM; ") + answering(fault), p);
    const double began = steady_seconds();
    for (int k = 0; k < max_missed_answers; ++k)
      EXPECT_EQ(driver->drive(amperes), DriveStatus::no_answer) << driver->report().reason;
    const StopReport zero = driver->stop();
    EXPECT_TRUE(zero.confirmed) << fault;
    EXPECT_LT(steady_seconds() - began, 0.8) << fault;
    EXPECT_TRUE(test::names(zero.trouble, "did not answer stop")) << zero.trouble;
    EXPECT_TRUE(test::names(trouble_text(*driver, DriveStatus::no_answer), "does not answer: "));
  }
}

TEST_F(LineProgram, OneThatStillObeysStopIsNotKilled) {
  LineDriverParams p = quick();
  p.reply_timeout = 0.2;
  const auto driver = start("echo one >>begun; " + answering(":"), p);
  for (int k = 0; k < max_missed_answers; ++k)
    EXPECT_EQ(driver->drive(amperes), DriveStatus::no_answer);
  const StopReport zero = driver->stop();
  EXPECT_TRUE(zero.good()) << zero.trouble;
  EXPECT_EQ(read_file(folder_ / "begun"), "one\n");
}

/// A card that holds its outputs until it is sent zeros.
TEST_F(LineProgram, AStopWithoutZeroBeginsOnceMore) {
  for (const char* said : {"ok $n 0 3 0", "ok $n 0 0", "ok $n nan nan nan", "ok $n", "off $n",
                           "refused $n busy", "emergency $n", "limited $n 0.5 0 0"}) {
    std::filesystem::remove(folder_ / "begun");
    {
      const auto driver =
          start(std::string("echo one >>begun; while read word n rest; do case $word in stop) ") +
                "echo " + said + ";; set) echo ok $n $rest;; *) echo ok $n 0 0 0;; esac; done");
      EXPECT_EQ(driver->drive(amperes), DriveStatus::driven);
      const StopReport zero = driver->stop();
      EXPECT_TRUE(zero.confirmed) << said;
      EXPECT_EQ(zero.trouble, "did not say zero to stop; it was ended, and a second one said zero");
      EXPECT_EQ(driver->report().currents[1], 0);
      EXPECT_EQ(driver->drive(amperes), DriveStatus::gone);
    }
    EXPECT_EQ(read_file(folder_ / "begun"), "one\none\n") << said;
    EXPECT_FALSE(lives());
  }
}

/// What the first one left of a line is not put before the answer of the second.
TEST_F(LineProgram, HalfALineOfTheOneThatEndedIsForgotten) {
  for (const char* last : {"printf 'ok 3 1 -2'; exit 1", "printf 'garbage'; kill -9 $$",
                           "head -c 20000 /dev/zero | tr '\\0' x; exit 1"}) {
    const auto driver = start(answering(last));
    EXPECT_EQ(driver->drive(amperes), DriveStatus::gone) << last;
    EXPECT_TRUE(driver->stop().confirmed) << last;
  }
  const auto flooded = start(
      "while read word n rest; do case $word in stop) exec tr '\\0' x </dev/zero;; set) echo ok $n "
      "$rest;; *) echo ok $n 0 0 0;; esac; done");
  EXPECT_EQ(flooded->drive(amperes), DriveStatus::driven);
  EXPECT_TRUE(flooded->stop().confirmed);
}

TEST_F(LineProgram, OneThatHangsIsKilledAfterTheStop) {
  const double began = steady_seconds();
  {
    const auto driver = start("trap '' TERM; " + answering("echo ok $n $rest") + "; exec sleep 99");
    EXPECT_EQ(driver->drive(amperes), DriveStatus::driven);
  }
  EXPECT_FALSE(lives());
  EXPECT_LT(steady_seconds() - began, 4);
}

TEST_F(LineProgram, HasItsCoilsForItselfAlsoWhenItsHostIsGone) {
  write_file_atomically(folder_ / "coils", "x");
  write_file_atomically(folder_ / "copy", "x");
  const std::string key = (folder_ / ".").string();
  const auto lock = [&](const std::string& file = "coils", const std::string& device = "") {
    return std::make_unique<DeviceLock>(folder_ / file, LineDevice{"a program", key + device});
  };
  const auto refuses_both = [&] {
    refuses([&] { lock("coils", "other"); }, (folder_ / "coils").string(), {"another program"});
    refuses([&] { lock("copy"); }, "a program", {"another program"});
  };
  {
    const auto driver = start(answering("echo ok $n $rest"), quick(), lock());
    refuses_both();
  }
  auto first = lock();
  auto program = start_program({"sh", "-c", "sleep 1000"}, folder_ / ".", first->descriptors());
  first.reset();
  refuses_both();
  program.reset();
  lock();
}

/// A copy of the coil file is no second amplifier.
TEST_F(LineProgram, ACommandHasOneHost) {
  write_file_atomically(folder_ / "driver.sh", answering("echo ok $n $rest"));
  std::filesystem::create_symlink(folder_ / "driver.sh", folder_ / "link.sh");
  std::filesystem::create_directory(folder_ / "other");
  write_file_atomically(folder_ / "other/driver.sh", answering("echo ok $n $rest"));
  const auto site = [&](const std::string& coils, const std::string& folder = ".") {
    write_file_atomically(folder_ / coils, "x");
    return CoilSite{folder_ / folder, folder_ / coils, 3};
  };
  const auto program = [&](const std::string& file) {
    ProgramDriverParams p;
    p.command = {"sh", file, "a"};
    return p;
  };
  {
    const auto first = program("driver.sh").open(site("one"));
    for (const char* again : {"driver.sh", "link.sh", "./driver.sh"})
      refuses([&] { program(again).open(site("two")); }, std::string("sh ") + again + " a",
              {"another program"});
    program("driver.sh").open(site("three", "other"));
  }
  program("driver.sh").open(site("two"));
}

}  // namespace
}  // namespace microswarm::actuation
