// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/vision/tracking/video_tracker.hpp"

namespace microswarm::cli {

/// `track --suggest`: settings of `find` that suit a video or a picture, and their `--set` line.
/// With `out`, the histogram of masses is drawn to its masses.png. Returns an exit code.
int suggest_tracking(const std::string& source, const vision::TrackSettings& settings,
                     const std::filesystem::path& out, bool json, const Stop& stop);

}  // namespace microswarm::cli
