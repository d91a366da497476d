// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"

namespace microswarm::vision {

/// The picture as a read-only OpenCV matrix, 8-bit with 1 or 3 channels, that shares the pixels.
inline cv::Mat as_mat(const formats::Image& image) {
  return {image.height, image.width, CV_8UC(image.channels),
          const_cast<std::uint8_t*>(image.pixels.data())};
}

/// The mask as a copied 8-bit matrix of 0 and 255.
inline cv::Mat to_mat(const formats::Mask& mask) {
  return cv::Mat(mask.height, mask.width, CV_8U, const_cast<std::uint8_t*>(mask.cells.data())) != 0;
}

/// Mask of the nonzero elements; `mat` is 8-bit with one channel.
inline formats::Mask to_mask(const cv::Mat& mat) {
  formats::Mask mask(mat.cols, mat.rows);
  for (int y = 0; y < mat.rows; ++y)
    for (int x = 0; x < mat.cols; ++x) mask.at(x, y) = mat.at<std::uint8_t>(y, x) != 0;
  return mask;
}

/// Copies an OpenCV picture, 8-bit with 1, 3 or 4 channels in BGR order, into `picture` and reuses
/// its memory.
inline void take_picture(const cv::Mat& mat, formats::Image& picture) {
  const int channels = mat.channels() == 1 ? 1 : 3;
  picture.width = mat.cols;
  picture.height = mat.rows;
  picture.channels = channels;
  picture.pixels.resize(mat.total() * static_cast<std::size_t>(channels));
  cv::Mat ours = as_mat(picture);
  if (channels == 1)
    mat.copyTo(ours);
  else
    cv::cvtColor(mat, ours, mat.channels() == 4 ? cv::COLOR_BGRA2RGB : cv::COLOR_BGR2RGB);
}

}  // namespace microswarm::vision
