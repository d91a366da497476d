// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "microswarm/vision/camera/camera_params.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm {

/// Opens a camera whose pictures come one by one, each waited for. The rate that the camera really
/// has is `rate()` of the source. Throws HardwareError "DEVICE: WHY" when there is no such device,
/// it is no camera or in use, or it does not take a setting; next() does so when it is unplugged,
/// gives no picture for 5 s beyond its exposure, or ten damaged ones in a row.
std::unique_ptr<FrameSource> open_camera(const CameraParams& params);

/// A camera whose newest frame is at hand; errors as above.
inline NewestFrame live_camera(const CameraParams& params) {
  return {open_camera(params), params.device, params.watch};
}

}  // namespace microswarm
