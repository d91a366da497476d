// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/camera.hpp"

namespace microswarm::cli {

/// Description of a camera in the help of commands that take a picture or a camera.
inline constexpr const char* camera_names = "camera such as /dev/video0 or genicam:ID";

/// Whether a source of pictures is a camera: "/dev/video0", "genicam:ID", or "genicam:" for the
/// first one found.
bool is_camera(const std::string& source);

/// Settings to open a source: `given` if they are for its kind of camera or the source is a file,
/// otherwise the defaults of its kind.
vision::AnyCameraParams camera_for(const std::string& source, const vision::AnyCameraParams& given);

/// The same with the camera of a rig file, if one is named, and settings by --set.
vision::AnyCameraParams find_camera(const std::string& source, const std::string& rig,
                                    const std::vector<std::string>& settings = {});

/// Picture from a file, or from a camera with these settings after settling for one second. Throws
/// InputError or HardwareError.
formats::Image take_picture(const std::string& source, const vision::AnyCameraParams& camera);
/// The same; a file may say its scale [µm], where none is given.
formats::Image take_picture(const std::string& source, const vision::AnyCameraParams& camera,
                            std::optional<double>& um_per_px);

}  // namespace microswarm::cli
