// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "microswarm/vision/camera/camera_params.hpp"
#include "microswarm/vision/camera/genicam_params.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm::vision {

/// Settings of a camera of any kind.
using AnyCameraParams = std::variant<CameraParams, GenicamParams>;

/// Name of the camera in messages and commands: "/dev/video0", "genicam:ID".
std::string device_name(const AnyCameraParams& params);

/// Opens a camera as a source whose next() waits for a picture; rate() returns the actual rate.
/// Throws HardwareError "DEVICE: WHY" if the device does not exist, is no camera, is in use or
/// refuses a setting; next() throws it if the camera is unplugged, delivers no picture for 5 s
/// beyond its exposure, or ten damaged ones in a row. Throws InputError for a GenICam camera in a
/// build without Aravis.
std::unique_ptr<FrameSource> open_camera(const AnyCameraParams& params);

/// Opens a camera that keeps its newest frame available; errors as above.
NewestFrame live_camera(const AnyCameraParams& params);

}  // namespace microswarm::vision
