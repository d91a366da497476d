// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "microswarm/vision/camera/camera_params.hpp"
#include "microswarm/vision/camera/genicam_params.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm {

/// Settings of a camera, whatever its kind.
using AnyCameraParams = std::variant<CameraParams, GenicamParams>;

/// Name of the camera in messages, as commands take it: "/dev/video0", "genicam:ID".
std::string device_name(const AnyCameraParams& params);

/// Opens a camera whose pictures come one by one, each waited for. The rate that the camera really
/// has is `rate()` of the source. Throws HardwareError "DEVICE: WHY" when there is no such device,
/// it is no camera or in use, or it does not take a setting; next() does so when it is unplugged,
/// gives no picture for 5 s beyond its exposure, or ten damaged ones in a row. Throws InputError
/// for a GenICam camera in a build without Aravis.
std::unique_ptr<FrameSource> open_camera(const AnyCameraParams& params);

/// A camera whose newest frame is at hand; errors as above.
NewestFrame live_camera(const AnyCameraParams& params);

}  // namespace microswarm
