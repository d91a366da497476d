// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace microswarm::vision {

// Pixel sets as 8-bit matrices of 0 and 255. Pieces are 8-connected, holes 4-connected.

/// The piece with the most pixels; the first in reading order among equals.
cv::Mat largest_piece(const cv::Mat& set);

/// The values, of floats, where the set is, in reading order.
std::vector<float> values_in(const cv::Mat& values, const cv::Mat& set);

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

/// The highest value in the square around each pixel: `side` pixels wide, of which (side − 1) / 2
/// lie left of it and above it; beyond the border is 0.
cv::Mat highest_around(const cv::Mat& values, int side);

/// Sets one more pixel wherever two set pixels are connected by a corner only, so that nothing has
/// to pass through a point.
void widen_corners(cv::Mat& set);

/// Distance [px] of each set pixel to the nearest unset one: radii of the largest inscribed discs.
cv::Mat depth_in(const cv::Mat& set);

}  // namespace microswarm::vision
