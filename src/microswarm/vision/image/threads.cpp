// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/threads.hpp"

#include <opencv2/core/utility.hpp>

namespace microswarm::vision {

void set_picture_threads(int threads) { cv::setNumThreads(threads); }

}  // namespace microswarm::vision
