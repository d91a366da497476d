// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/camera_params.hpp"

namespace microswarm::cli {

/// Whether a source of pictures is a device, such as /dev/video0.
inline bool is_camera(const std::string& source) { return source.starts_with("/dev/"); }

/// The camera of a rig file, or the defaults where it has none of V4L2 or no file is named.
CameraParams camera_of(const std::string& rig);

/// Picture of a file, or of a camera with these settings after one second of settling. Throws
/// InputError or HardwareError.
Image picture_of(const std::string& source, CameraParams camera);

}  // namespace microswarm::cli
