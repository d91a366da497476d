// SPDX-License-Identifier: Apache-2.0
// Inside the module only.
#pragma once

#include <filesystem>
#include <memory>

#include "microswarm/formats/media/media.hpp"

namespace microswarm::formats {

/// Opens a video; null if it cannot be read.
std::unique_ptr<VideoInput> open_libav(const std::filesystem::path& file);

/// Number of the video's pictures, not decoded; 0 if it cannot be read.
int count_libav_packets(const std::filesystem::path& file);

}  // namespace microswarm::formats
