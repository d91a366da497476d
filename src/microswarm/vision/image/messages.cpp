// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/messages.hpp"

#include <cstdlib>
#include <opencv2/core/utils/logger.hpp>

namespace microswarm::vision {

void silence_picture_messages() {
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

}  // namespace microswarm::vision
