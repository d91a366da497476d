// SPDX-License-Identifier: Apache-2.0
// Inside the module only.
#pragma once

extern "C" {
#include <libavutil/log.h>
}

#include <cstdlib>

namespace microswarm::formats {

/// The library's messages as OpenCV sets them: errors, or what its environment variable says.
inline void set_messages() {
  static const bool once = [] {
    const char* level = std::getenv("OPENCV_FFMPEG_LOGLEVEL");
    av_log_set_level(level ? std::atoi(level) : AV_LOG_ERROR);
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace microswarm::formats
