// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/learning/follower_tasks.hpp"
#include "microswarm/navigation/following/follower_model.hpp"

namespace microswarm::learning {

/// Features of a learned follower and the expert's command for them.
struct Demonstration {
  std::array<double, navigation::feature_count> features;
  std::array<double, 2> answer;  ///< heading relative to the bearing [rad], fraction of the speed
};

/// Runs the task and records the expert's command at each tick. With a student, the student drives
/// and the expert only labels (DAgger, Ross 2011); otherwise the expert drives.
std::vector<Demonstration> demonstrate(
    const FollowerTask& task, const std::shared_ptr<const navigation::FollowerModel>& student,
    const Stop& stop = {});

}  // namespace microswarm::learning
