// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/rig_meter.hpp"

#include <gtest/gtest.h>

#include "tests/rig/coil_rig.hpp"

namespace microswarm::rig {
namespace {

TEST(RigMeter, TheRateOfCurrentsIsThatOfTheTimeInWhichTheyWereSent) {
  const test::Folder folder;
  const Rig rig = test::coil_rig(folder, "[{}, {}, {}]");
  RigMeter meter(rig.system, 0.1);
  EXPECT_EQ(meter.timing().sent_rate(), 0);
  CoilMoment moment;
  moment.output.currents = moment.output.acknowledged = moment.output.temperatures =
      Eigen::VectorXd::Zero(3);
  for (int i = 0; i <= 50; ++i) {
    moment.t = 7 + 0.02 * i;
    meter.add_output(moment);
  }
  EXPECT_NEAR(meter.timing().sent_rate(), 50, 1e-6);
  EXPECT_NEAR(meter.timing().sent_for, 1, 1e-9);
}

}  // namespace
}  // namespace microswarm::rig
