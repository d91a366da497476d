// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/still_ground.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "microswarm/vision/ground.hpp"

namespace microswarm {
namespace {

constexpr double dark = 0.8;           // of the ground
constexpr double brighter_rate = 0.1;  // learned from a picture: robots only make it darker
constexpr double darker_rate = 0.03;

cv::Mat disc(int radius) {
  const int side = 2 * radius + 1;
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
}

}  // namespace

StillGround::StillGround(const Mask& walls, int reach) : reach_(reach) {
  cv::Mat on(walls.height, walls.width, CV_8U);
  for (std::size_t i = 0; i < walls.cells.size(); ++i) on.data[i] = walls.cells[i] ? 255 : 0;
  free_ = 255 - on;
  cv::Mat reached, wide_walls;
  cv::dilate(free_, reached, disc(reach));
  cv::dilate(on, wide_walls, disc(reach));
  beyond_ = 255 - reached;
  at_edge_ = reached & wide_walls;
}

void StillGround::compare_with_light(const Image& picture) {
  const cv::Mat grey(picture.height, picture.width, CV_8U,
                     const_cast<std::uint8_t*>(picture.pixels.data()));
  cv::divide(grey, cv::max(ground_of(grey, free_), 1), share_, 1, CV_32F);
}

const Image& StillGround::take_out(const Image& picture) {
  compare_with_light(picture);
  if (ground_.empty()) {
    ground_ = cv::Mat::ones(share_.size(), CV_32F);
    share_.copyTo(ground_, at_edge_);
  }
  open_.width = picture.width;
  open_.height = picture.height;
  open_.pixels.resize(picture.pixels.size());
  cv::Mat out(picture.height, picture.width, CV_8U, open_.pixels.data());
  cv::Mat(share_ / cv::max(ground_, 0.05)).convertTo(out, CV_8U, level);
  out.setTo(level, beyond_);
  return open_;
}

bool StillGround::is_dark(Vec2 at_px) const {
  const auto column = static_cast<int>(std::lround(at_px.x));
  const auto row = static_cast<int>(std::lround(at_px.y));
  if (column < 0 || row < 0 || column >= open_.width || row >= open_.height) return false;
  return open_.pixels[open_.index(column, row)] < dark * level;
}

void StillGround::learn(std::span<const Vec2> robots) {
  cv::Mat empty(share_.size(), CV_8U, cv::Scalar(255));
  for (const Vec2 robot : robots)
    cv::circle(empty,
               {static_cast<int>(std::lround(robot.x)), static_cast<int>(std::lround(robot.y))},
               reach_ + 1, 0, cv::FILLED);
  const cv::Mat off = share_ - ground_;
  cv::Mat brighter = (off > 0) & empty;
  cv::Mat darker = (off <= 0) & empty;
  cv::Mat learned = ground_ + brighter_rate * off;
  learned.copyTo(ground_, brighter);
  learned = ground_ + darker_rate * off;
  learned.copyTo(ground_, darker);
}

}  // namespace microswarm
