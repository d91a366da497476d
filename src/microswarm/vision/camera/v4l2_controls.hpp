// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/vision/camera/camera_params.hpp"
#include "microswarm/vision/camera/v4l2_device.hpp"

namespace microswarm {

/// Sets exposure, gain, white balance and focus, and asks the camera whether it has them. What is
/// not given becomes automatic, where the camera can. Throws HardwareError "DEVICE: WHY" when it
/// does not take a value that is given.
void set_controls(const V4l2Device& device, const CameraParams& params);

}  // namespace microswarm
