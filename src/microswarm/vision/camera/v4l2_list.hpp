// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/vision/camera/camera_list.hpp"

namespace microswarm::vision {

/// Lists the connected V4L2 cameras.
std::vector<ListedCamera> list_v4l2_cameras();

}  // namespace microswarm::vision
