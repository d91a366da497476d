// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm::vision {

/// Connects the pieces of a set across gaps. Shortest paths grow from all pieces at once; the cost
/// of a pixel is `cost` (32-bit, above 0) times its length. Paths of two pieces that meet at a
/// total cost of at most `most` become bridges, cheapest first. A bridge is as wide as the narrower
/// of its two ends. Pieces that are already connected get no further bridge. Returns the number of
/// bridges.
int bridge_gaps(cv::Mat& set, const cv::Mat& cost, double most);

}  // namespace microswarm::vision
