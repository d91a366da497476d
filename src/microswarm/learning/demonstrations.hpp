// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "microswarm/core/stop.hpp"
#include "microswarm/learning/follower_tasks.hpp"
#include "microswarm/navigation/following/follower_model.hpp"

namespace microswarm {

/// What the expert would have commanded where a learned follower saw this.
struct Demonstration {
  std::array<double, feature_count> features;
  std::array<double, 2> answer;  ///< heading off the bearing [rad], share of the speed
};

/// Runs the task and notes what the expert commands at each tick. With a student, that one drives
/// and the expert only says what it would have done there (DAgger, Ross 2011); else the expert
/// drives.
std::vector<Demonstration> demonstrate(const FollowerTask& task,
                                       const std::shared_ptr<const FollowerModel>& student,
                                       const Stop& stop = {});

}  // namespace microswarm
