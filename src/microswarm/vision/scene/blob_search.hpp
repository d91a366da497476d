// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/vision/scene/blobs.hpp"

namespace microswarm::vision {

// Steps of `find_blobs`, over a whole picture or a part of it.

/// Picture pixels per side of a working pixel. Coarser pixels reduce noise and time.
int coarseness(const BlobParams& params);

/// Block means over `side` × `side` pixels; the border is replicated to fill the last blocks.
cv::Mat downsampled(const cv::Mat& mat, int side);

/// The walls as an 8-bit matrix that shares the cells; empty without walls. Throws InputError if
/// they have another size than the picture.
cv::Mat walls_over(const formats::Image& picture, const formats::Mask* walls);

/// Mask of the working pixels to search (255), or an empty matrix if all are searched.
cv::Mat visible_pixels(const cv::Mat& walls, int side);

/// Smoothed difference of each working pixel from the `ground`; 0 where nothing is seen.
cv::Mat subtract_background(const cv::Mat& grey, const cv::Mat& seen, cv::Mat ground, bool dark,
                            double spread);

/// Spread of the background around its surface, from the median of about ten thousand pixels.
double ground_spread(const cv::Mat& foreground, const cv::Mat& seen);

/// The least difference from the background that counts, for this spread of it.
float min_foreground(const BlobParams& params, double spread);

/// Data of the search: the picture, the searched pixels and the foreground, the latter two in
/// working pixels.
struct BlobContext {
  int side = 1;  ///< of a working pixel
  cv::Mat fine{};
  cv::Mat seen{};
  cv::Mat foreground{};
};

/// Mean squared difference of neighbours in a picture row, over every `step`th row of the working
/// pixels set in `chosen` (over `box`).
double roughness(const BlobContext& field, const cv::Rect& box, const cv::Mat& chosen, int step);

/// Appends the blobs that rise by `least`; `noise` is the roughness of the background. `refused` as
/// in `find_blobs`.
void add_blobs(const BlobContext& field, const BlobParams& params, float least, double noise,
               std::vector<Blob>& blobs, std::vector<Blob>* refused = nullptr);

/// Sorts by decreasing area.
void sort_by_size(std::vector<Blob>& blobs);

}  // namespace microswarm::vision
