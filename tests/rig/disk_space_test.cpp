// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/disk_space.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/runtime/command_log.hpp"
#include "tests/messages.hpp"
#include "tests/rig/coil_rig.hpp"

namespace microswarm::rig {
namespace {

TEST(DiskSpace, OfALogIsNotUnderestimatedAndNotByFar) {
  const test::Folder folder;
  const Rig rig = test::coil_rig(folder, "[{}, {}, {}]");
  CommandLog log(folder / "", rig.system, false);
  const int outputs = static_cast<int>(10 * rig.params.drive_rate);
  for (int i = 0; i < outputs; ++i)
    log.add({.t = 1234.5678 + i,
             .seen = 1234.4567 + i,
             .command = {1.23456, 45.678},
             .output = {.wanted = {1.23456, -2.34567, 0.12345},
                        .currents = Eigen::Vector3d(0.12345, -2.34567, 3.14159),
                        .scale = 0.7512,
                        .device_scale = 0.6251},
             .late = 0.000123,
             .round_trip = 0.002345},
            0);
  log.finish({.confirmed = true, .at = 2e4});
  const auto written = static_cast<double>(std::filesystem::file_size(folder / "commands.csv"));
  EXPECT_GT(needed_space(rig, 0.1, 10), written);
  EXPECT_LT(needed_space(rig, 0.1, 10), 5 * written);
}

// An hour before the end of a long run its first hours are on the disk already.
TEST(DiskSpace, WhatIsWrittenIsNotNeededAgain) {
  const test::Folder folder;
  const Rig rig = test::coil_rig(folder, "[{}, {}, {}]");
  const double all = needed_space(rig, 0.1, 36'000);
  const double rest = needed_space(rig, 0.1, 36'000, 32'400);
  EXPECT_LT(rest, 0.7 * all);
  EXPECT_GT(rest, needed_space(rig, 0.1, 3'600));  // the whole record is written once more
}

TEST(DiskSpace, OfALongRunMustBeThere) {
  EXPECT_NO_THROW(require_space("out", 1e9, 6e8));
  try {
    require_space("out/night", 2e9, 3e8);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(test::is_one_line_naming(error.what(), "out/night", {"300 MB", "2000 MB"}))
        << error.what();
  }
  const test::Folder folder;
  EXPECT_GT(free_space(folder / "not/yet").value_or(0), 0);
}

}  // namespace
}  // namespace microswarm::rig
