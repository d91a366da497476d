// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/logs.hpp"

#include <algorithm>
#include <cassert>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm::vision {

cv::Mat log_image(const cv::Mat& grey, double by) {
  assert(grey.type() == CV_8U);
  cv::Mat table(1, 256, CV_32F);
  for (int v = 0; v < table.cols; ++v)
    table.at<float>(v) = static_cast<float>(maths::log(std::max(1.0, v + by)));
  cv::Mat logs;
  cv::LUT(grey, table, logs);
  return logs;
}

void to_exponentials(cv::Mat& values) {
  assert(values.type() == CV_32F);
  for (int y = 0; y < values.rows; ++y) {
    auto* row = values.ptr<float>(y);
    std::transform(row, row + values.cols, row,
                   [](float x) { return static_cast<float>(maths::exp(static_cast<double>(x))); });
  }
}

}  // namespace microswarm::vision
