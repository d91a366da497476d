// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/command_log.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <numbers>
#include <thread>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::rig {
namespace {

TEST(CommandLog, HasItsFixedColumnsAndOneForEachCoil) {
  const test::Folder folder;
  const actuation::CoilSystem system(
      read_yaml_text<actuation::CoilSystemParams>("coils: {type: helmholtz}", "rig.yaml"),
      "rig.yaml");
  const std::string wanted =
      "t_s,heading_deg,speed_um_per_s,bx_mt,by_mt,bz_mt,i_x_a,i_y_a,i_z_a,scale,device_scale,"
      "status,late_s,"
      "round_trip_s,seen_s\n"
      "0.5,90,12.346,0.5,-1.23457,0,0.1,-2,3.14159,0.75,0.625,driven,0.000123,0.002,0.4875\n"
      "0.6,90,12.346,0.5,-1.23457,0,0.1,-2,3.14159,0.75,,no_answer,0.000123,0.002,0.4875\n"
      "0.75,,0,0,0,0,0,0,0,1,,zero,,,\n";
  CoilMoment moment{.t = 100,
                    .seen = 99.98754,
                    .command = {std::numbers::pi / 2, 12.345678},
                    .output = {.wanted = {0.5, -1.234567, 0},
                               .currents = Eigen::Vector3d(0.1, -2, 3.14159265),
                               .scale = 0.75,
                               .device_scale = 0.625},
                    .late = 0.0001234,
                    .round_trip = 0.002};
  CommandLog log(folder / "", system, false);
  log.add(moment, 99.5);
  moment.t += 0.1;
  moment.output.status = actuation::DriveStatus::no_answer;
  log.add(moment, 99.5);
  EXPECT_EQ(log.finish({.confirmed = true, .at = 100.25}), "");
  EXPECT_EQ(read_file(folder / "commands.csv", 1 << 20), wanted);
}

/// Lines of ten bytes.
std::string numbered(int n) { return fmt::format("{:09}\n", n); }

TEST(LogParts, ReadAsOneTheyHaveEveryLineOnceInOrder) {
  const test::Folder folder;
  const std::filesystem::path log = folder / "commands.csv";
  std::string wanted = "head\n";
  {
    LogParts parts(log, "head\n", {.part_bytes = 105, .sync_period = 1e-3});
    for (int i = 0; i < 1000; ++i) {
      parts.add(numbered(i));
      wanted += numbered(i);
      if (i % 100 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_EQ(parts.finish(), "");
  }
  const std::vector<std::filesystem::path> parts = log_parts(log);
  EXPECT_EQ(parts.size(), 100u);
  EXPECT_EQ(parts.front().filename(), "commands-0001.csv");
  EXPECT_EQ(parts.back(), log);
  EXPECT_TRUE(std::ranges::is_sorted(parts));
  for (const auto& part : parts) {
    EXPECT_LE(std::filesystem::file_size(part), 105u);
    EXPECT_TRUE(read_file(part).starts_with("head\n")) << part;
  }
  EXPECT_FALSE(std::filesystem::exists(log.string() + ".part"));
  EXPECT_EQ(read_log(log), wanted);
}

TEST(LogParts, ALineThatIsLongerThanAPartHasOneOfItsOwn) {
  const test::Folder folder;
  const std::filesystem::path log = folder / "commands.csv";
  LogParts parts(log, "head\n", {.part_bytes = 12});
  const std::string lines = "a\n" + std::string(40, 'b') + "\nc\n";
  parts.add(lines);
  EXPECT_EQ(parts.finish(), "");
  EXPECT_EQ(log_parts(log).size(), 3u);
  EXPECT_EQ(read_log(log), "head\n" + lines);
}

TEST(LogParts, ThoseOfAnEarlierLogGoWithTheFirstLine) {
  const test::Folder folder;
  const std::filesystem::path log = folder / "commands.csv";
  const auto write_log = [&](int lines) {
    LogParts parts(log, "head\n", {.part_bytes = 15});
    for (int i = 0; i < lines; ++i) parts.add(numbered(i));
    if (lines > 0) {
      EXPECT_EQ(parts.finish(), "");
    }
  };
  write_log(5);
  EXPECT_EQ(log_parts(log).size(), 5u);
  write_log(0);  // a run that was refused
  EXPECT_EQ(log_parts(log).size(), 5u);
  EXPECT_FALSE(std::filesystem::exists(log.string() + ".part"));
  write_log(2);
  EXPECT_EQ(log_parts(log).size(), 2u);
  EXPECT_EQ(read_log(log), "head\n" + numbered(0) + numbered(1));
}

TEST(LogParts, AMissingPartAndAnotherHeaderAreTold) {
  const test::Folder folder;
  const std::filesystem::path log = folder / "commands.csv";
  EXPECT_THROW(read_log(log), InputError);
  write_file_atomically(folder / "commands-0001.csv", "t_s,a\n1,2\n");
  write_file_atomically(folder / "commands-0003.csv", "t_s,a\n5,6\n");
  EXPECT_TRUE(test::names(test::error_of([&] { read_log(log); }), "commands-0002.csv"));
  write_file_atomically(log, "t_s,a\n3,4\n");
  EXPECT_TRUE(test::names(test::error_of([&] { read_log(log); }), "commands-0002.csv"));
  std::filesystem::remove(folder / "commands-0003.csv");
  EXPECT_EQ(read_log(log), "t_s,a\n1,2\n3,4\n");
  write_file_atomically(log, "t_s,b\n3,4\n");
  try {
    read_log(log);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(test::is_one_line_naming(error.what(), log.string(), {"header"}));
  }
}

TEST(LogParts, AKilledProgramHasLostNoLineThatWasSynced) {
  const test::Folder folder;
  const std::filesystem::path log = folder / "commands.csv";
  const pid_t child = ::fork();
  if (child == 0) {
    LogParts parts(log, "head\n", {.part_bytes = 25, .sync_period = 1e-3});
    for (int i = 0; i < 7; ++i) parts.add(numbered(i));
    const auto payload = [&] {  // of all parts, without their headers
      std::uintmax_t bytes = 0;
      for (const auto& entry : std::filesystem::directory_iterator(log.parent_path()))
        bytes += std::filesystem::file_size(entry) - std::string_view("head\n").size();
      return bytes;
    };
    std::uintmax_t wanted = 0;
    for (int i = 0; i < 7; ++i) wanted += numbered(i).size();
    for (int wait = 0; wait < 1000 && payload() != wanted; ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WTERMSIG(status), SIGKILL);
  const std::string part = log.string() + ".part";
  ASSERT_TRUE(std::filesystem::exists(part));
  std::filesystem::rename(part, log);
  std::string wanted = "head\n";
  for (int i = 0; i < 7; ++i) wanted += numbered(i);
  EXPECT_EQ(read_log(log), wanted);
}

TEST(LogParts, ALinkInItsPlaceIsNotFollowed) {
  const test::Folder folder;
  std::filesystem::create_symlink("/dev/full", folder / "commands.csv.part");
  LogParts parts(folder / "commands.csv", "head\n");
  parts.add("a\n");
  EXPECT_EQ(parts.finish(), "");
  EXPECT_EQ(read_log(folder / "commands.csv"), "head\na\n");
}

TEST(LogParts, AFullDiskIsToldWithALaterLine) {
  const test::Folder folder;
  const std::filesystem::path log = folder / "commands.csv";
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{30, 30};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
    LogParts parts(log, "head\n", {.sync_period = 1e-3});
    bool told = false;
    for (int i = 0; i < 1000 && !told; ++i) {
      try {
        parts.add(numbered(i));
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      } catch (const InputError& error) {
        told = std::string(error.what()).find("cannot write: File too large") != std::string::npos;
      }
    }
    const bool kept = parts.finish().find("partial log kept as") != std::string::npos;
    ::_exit(told && kept ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_file(log.string() + ".part"), "head\n" + numbered(0) + numbered(1) + "00000");
}

}  // namespace
}  // namespace microswarm::rig
