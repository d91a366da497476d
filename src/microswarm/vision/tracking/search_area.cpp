// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/search_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::vision {
namespace {

std::string sides_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

const formats::Image& SearchArea::crop(const formats::Image& grey) {
  if (!region_ && mask_.cells.empty()) return grey;
  if (grey.width != width_ || grey.height != height_) fit(grey);
  cut_.width = part_.width;
  cut_.height = part_.height;
  cut_.channels = 1;
  cut_.pixels.clear();
  for (int row = part_.y; row < part_.y + part_.height; ++row) {
    const std::uint8_t* first = grey.pixels.data() + grey.index(part_.x, row);
    cut_.pixels.insert(cut_.pixels.end(), first, first + part_.width);
  }
  return cut_;
}

void SearchArea::fit(const formats::Image& grey) {
  width_ = grey.width;
  height_ = grey.height;
  const std::string size = sides_text(width_, height_);
  if (region_ && (region_->x > width_ - region_->width || region_->y > height_ - region_->height))
    throw InputError("region: ends at column " + std::to_string(region_->x + region_->width) +
                     " and row " + std::to_string(region_->y + region_->height) +
                     ", the pictures have " + size + " pixels");
  if (!mask_.cells.empty() && (mask_.width != width_ || mask_.height != height_))
    throw InputError("mask: has " + sides_text(mask_.width, mask_.height) +
                     " pixels, the pictures have " + size);
  int left = width_, right = -1, top = height_, bottom = -1;
  for (int row = 0; row < height_; ++row)
    for (int column = 0; column < width_; ++column) {
      if (!contains({1.0 * column, 1.0 * row})) continue;
      left = std::min(left, column);
      right = std::max(right, column);
      top = std::min(top, row);
      bottom = std::max(bottom, row);
    }
  if (right < 0) throw InputError("mask: no pixel of it is light, so there is nothing to track in");
  part_.x = std::max(0, left - reach_);
  part_.y = std::max(0, top - reach_);
  part_.width = std::min(width_ - 1, right + reach_) - part_.x + 1;
  part_.height = std::min(height_ - 1, bottom + reach_) - part_.y + 1;
}

bool SearchArea::contains(Vec2 at_px) const {
  const auto column = static_cast<int>(std::lround(at_px.x));
  const auto row = static_cast<int>(std::lround(at_px.y));
  if (region_ && (column < region_->x || row < region_->y ||
                  column >= region_->x + region_->width || row >= region_->y + region_->height))
    return false;
  if (mask_.cells.empty()) return true;
  return column >= 0 && row >= 0 && column < mask_.width && row < mask_.height &&
         mask_.at(column, row) != 0;
}

}  // namespace microswarm::vision
