// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace microswarm::vision {

/// Neighbouring pixels of a row that are set, from `begin` to before `end`.
struct PixelRun {
  int row = 0;
  int begin = 0, end = 0;
};

/// A connected set of pixels.
struct RunPiece {
  std::vector<PixelRun> runs{};  ///< row by row
  cv::Rect box{};
  int area = 0;  ///< [px]
};

/// The pieces of the pixels of an 8-bit matrix that are not 0, connected by edges, in the order of
/// their first pixels row by row; the same as those of cv::connectedComponents. Faster where few
/// pixels are set, as rows are skipped by words and pixels get no labels.
std::vector<RunPiece> connected_runs(const cv::Mat& set);

}  // namespace microswarm::vision
