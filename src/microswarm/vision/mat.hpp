// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "microswarm/formats/image.hpp"
#include "microswarm/formats/mask.hpp"

namespace microswarm {

/// The picture as OpenCV sees it, 8-bit with 1 or 3 channels; it shares the pixels, read only.
inline cv::Mat as_mat(const Image& image) {
  return {image.height, image.width, CV_8UC(image.channels),
          const_cast<std::uint8_t*>(image.pixels.data())};
}

/// The mask as an 8-bit matrix of 0 and 255, a copy.
inline cv::Mat to_mat(const Mask& mask) {
  return cv::Mat(mask.height, mask.width, CV_8U, const_cast<std::uint8_t*>(mask.cells.data())) != 0;
}

/// The mask of the elements that are not 0; `mat` is 8-bit, one channel.
inline Mask to_mask(const cv::Mat& mat) {
  Mask mask(mat.cols, mat.rows);
  for (int y = 0; y < mat.rows; ++y)
    for (int x = 0; x < mat.cols; ++x) mask.at(x, y) = mat.at<std::uint8_t>(y, x) != 0;
  return mask;
}

}  // namespace microswarm
