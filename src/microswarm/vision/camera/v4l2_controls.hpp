// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/vision/camera/camera_params.hpp"
#include "microswarm/vision/camera/v4l2_device.hpp"

namespace microswarm::vision {

/// Sets exposure, gain, white balance and focus and reads them back. Settings that are not given
/// become automatic if the camera can. Throws HardwareError "DEVICE: WHY" if it refuses a given
/// value.
void set_controls(const V4l2Device& device, const CameraParams& params);

}  // namespace microswarm::vision
