// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm {

/// Pixel sets as 8-bit matrices of 0 and 255. Pieces are 8-connected, holes 4-connected.

/// The piece with the most pixels; the first in reading order among equals.
cv::Mat largest_piece(const cv::Mat& set);

/// Number of pieces.
int count_pieces(const cv::Mat& set);

/// The pieces of at least `min_area` pixels.
cv::Mat without_small_pieces(const cv::Mat& set, double min_area);

/// The pieces that contain a pixel of `seeds`.
cv::Mat pieces_with(const cv::Mat& set, const cv::Mat& seeds);

/// Fills the holes of at most `max_area` pixels that do not touch the border.
void fill_holes(cv::Mat& set, double max_area);

/// Morphological opening with a disc of `diameter` pixels.
cv::Mat opened(const cv::Mat& set, double diameter);

/// The set dilated by `radius` pixels.
cv::Mat grown(const cv::Mat& set, double radius);

/// Sets a third pixel wherever two pixels are connected only by a corner, so a path inside the set
/// never passes through a point.
void widen_corners(cv::Mat& set);

/// Distance [px] of each set pixel to the nearest unset one: radii of the largest inscribed discs.
cv::Mat depth_in(const cv::Mat& set);

}  // namespace microswarm
