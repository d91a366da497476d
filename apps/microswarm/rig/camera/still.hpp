// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/camera.hpp"

namespace microswarm::cli {

/// How commands that take a picture or a camera name the latter.
inline constexpr const char* camera_names = "camera such as /dev/video0 or genicam:ID";

/// Whether a source of pictures is a camera: "/dev/video0", "genicam:ID", "genicam:" for the first
/// one that is found.
bool is_camera(const std::string& source);

/// The settings with which a source is opened: `given`, if they are those of its kind of camera,
/// else the defaults of this kind. For a file they are `given`.
AnyCameraParams camera_for(const std::string& source, const AnyCameraParams& given);

/// The same with the camera of a rig file, if one is named, and settings of its own, as of --set.
AnyCameraParams camera_of(const std::string& source, const std::string& rig,
                          const std::vector<std::string>& settings = {});

/// Picture of a file, or of a camera with these settings after one second of settling. Throws
/// InputError or HardwareError.
Image picture_of(const std::string& source, const AnyCameraParams& camera);

}  // namespace microswarm::cli
