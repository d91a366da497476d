// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/vessels.hpp"

#include <algorithm>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/image/mask_ops.hpp"
#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/vessels/field_of_view.hpp"
#include "microswarm/vision/vessels/line_vessels.hpp"
#include "microswarm/vision/vessels/region_vessels.hpp"

namespace microswarm::vision {
namespace {

constexpr double clearly_two = 0.9;  // separability above which two greys are segmented as regions

void require_picture(const formats::Image& image) {
  if (image.width < 1 || image.height < 1) throw InputError("picture to segment: no pixels");
  if (image.channels != 1 && image.channels != 3)
    throw InputError("picture to segment: " + std::to_string(image.channels) +
                     " channels, expected 1 or 3");
}

/// The channel with the highest contrast of blood.
cv::Mat green_channel(const formats::Image& image) {
  cv::Mat picture = as_mat(image);
  if (image.channels == 1) return picture;
  cv::Mat green;
  cv::extractChannel(picture, green, 1);
  return green;
}

FoundVessels found_in(const cv::Mat& grey, const cv::Mat& view, const VesselParams& params,
                      VesselMethod& method, const Stop& stop) {
  const TwoGreys greys = two_greys(grey, view);
  method = params.method;
  if (method == VesselMethod::automatic)
    method = greys.separability > clearly_two ? VesselMethod::regions : VesselMethod::lines;
  if (method == VesselMethod::lines)
    return line_vessels(grey, view, params.polarity == Polarity::bright, params, stop);
  const bool bright = params.polarity == Polarity::automatic ? bright_is_network(greys, view)
                                                             : params.polarity == Polarity::bright;
  return region_vessels(greys, view, bright, params);
}

}  // namespace

VesselSegmentation segment_vessels(const formats::Image& image, const VesselParams& params,
                                   const Stop& stop) {
  require_picture(image);
  VesselSegmentation result;
  result.field_of_view = field_of_view(image);
  const cv::Mat view = to_mat(result.field_of_view);
  FoundVessels found = found_in(green_channel(image), view, params, result.method, stop);
  result.wide_width_px = found.wide_width_px;
  result.scale = found.scale;
  result.bridges = found.bridges;

  cv::Mat vessels = stop() ? cv::Mat::zeros(view.size(), CV_8U) : found.vessels;
  if (params.min_width > 0) vessels = opened(vessels, params.min_width);
  widen_corners(vessels);
  vessels &= view;
  result.pieces = count_pieces(vessels);
  const double all = cv::countNonZero(vessels);
  if (params.keep == KeepPieces::largest) vessels = largest_piece(vessels);
  const double kept = cv::countNonZero(vessels);
  if (all > 0) result.kept_share = kept / all;
  result.view_share = kept / std::max(1, cv::countNonZero(view));
  result.vessels = to_mask(vessels);
  return result;
}

}  // namespace microswarm::vision
