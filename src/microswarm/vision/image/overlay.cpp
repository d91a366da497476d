// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/overlay.hpp"

#include <algorithm>
#include <opencv2/core.hpp>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/image/mask_ops.hpp"
#include "microswarm/vision/image/mat.hpp"

namespace microswarm::vision {
namespace {

constexpr double screen = 1200;  // [px] size of a picture in which a line is one pixel thick

formats::Image in_colour(const formats::Image& picture) {
  if (picture.channels == 3) return picture;
  formats::Image colour{picture.width, picture.height, 3, {}};
  colour.pixels.reserve(3 * picture.pixels.size());
  for (const std::uint8_t grey : picture.pixels) colour.pixels.insert(colour.pixels.end(), 3, grey);
  return colour;
}

}  // namespace

formats::Image overlay(const formats::Image& picture, const formats::Mask& mask,
                       std::array<std::uint8_t, 3> rgb) {
  if (picture.width != mask.width || picture.height != mask.height)
    throw InputError("overlay: the mask is " + std::to_string(mask.width) + "x" +
                     std::to_string(mask.height) + " pixels, expected " +
                     std::to_string(picture.width) + "x" + std::to_string(picture.height));
  const double thickness = std::max(1.0, std::max(mask.width, mask.height) / screen);
  const cv::Mat set = to_mat(mask);
  const formats::Mask line = to_mask(grown(set, thickness) & ~set);
  formats::Image result = in_colour(picture);
  for (std::size_t i = 0; i < line.cells.size(); ++i)
    if (line.cells[i]) std::copy(rgb.begin(), rgb.end(), result.pixels.begin() + 3 * i);
  return result;
}

}  // namespace microswarm::vision
