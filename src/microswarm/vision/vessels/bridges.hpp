// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm {

/// Joins the pieces of a set over gaps: shortest paths grow from all pieces at once, a pixel
/// costing `cost` (32-bit, above 0) times its length, and where those of two pieces meet for no
/// more than `most` in all, the cheapest first, the path is set as wide as the narrower of its two
/// ends. Returns how many bridges were built; a pair of pieces that is joined already gets none.
int bridge_gaps(cv::Mat& set, const cv::Mat& cost, double most);

}  // namespace microswarm
