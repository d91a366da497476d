// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/command_log.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "microswarm/config/yaml.hpp"
#include "tests/files.hpp"

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

}  // namespace
}  // namespace microswarm::rig
