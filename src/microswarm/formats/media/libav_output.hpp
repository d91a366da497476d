// SPDX-License-Identifier: Apache-2.0
// Inside the module only.
#pragma once

#include <filesystem>
#include <memory>

#include "microswarm/formats/media/media.hpp"

namespace microswarm::formats {

/// Creates an H.264 video of colour pictures; null without such an encoder. If the file cannot be
/// written, its finish() returns why.
std::unique_ptr<VideoOutput> create_h264(const std::filesystem::path& file, const VideoForm& form);

}  // namespace microswarm::formats
