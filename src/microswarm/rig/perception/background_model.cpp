// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/background_model.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/vision/scene/background.hpp"

namespace microswarm::rig {
namespace {

constexpr double dark = 0.8;           // relative to the background
constexpr float brighter_rate = 0.1F;  // learning rate per picture; fast because robots only darken
constexpr float darker_rate = 0.03F;
constexpr float min_ground = 0.05F;

cv::Mat disc(int radius) {
  const int side = 2 * radius + 1;
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
}

MICROSWARM_EACH_CPU void divide(std::span<const std::uint8_t> grey, const float* light,
                                float* share) {
  for (std::size_t i = 0; i < grey.size(); ++i)
    share[i] = static_cast<float>(grey[i]) / (light[i] > 1.0F ? light[i] : 1.0F);
}

/// Divides by the background and scales to greys; `level` where `beyond` is set.
MICROSWARM_EACH_CPU void level_out(std::span<const float> share, const float* background,
                                   const std::uint8_t* beyond, std::uint8_t* grey) {
  constexpr auto level = static_cast<float>(BackgroundModel::level);
  for (std::size_t i = 0; i < share.size(); ++i) {
    const float of_ground = share[i] / (background[i] > min_ground ? background[i] : min_ground);
    const float value = level * (beyond[i] ? 1.0F : of_ground) + 0.5F;
    grey[i] = static_cast<std::uint8_t>(static_cast<int>(value < 255.0F ? value : 255.0F));
  }
}

/// Moves the background towards the picture where `empty` is set.
MICROSWARM_EACH_CPU void approach(std::span<const float> seen, const std::uint8_t* empty,
                                  float* background) {
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const float off = seen[i] - background[i];
    const float rate = off > 0.0F ? brighter_rate : darker_rate;
    background[i] += empty[i] ? rate * off : 0.0F;
  }
}

}  // namespace

BackgroundModel::BackgroundModel(const formats::Mask& walls, int reach) : reach_(reach) {
  cv::Mat on(walls.height, walls.width, CV_8U);
  for (std::size_t i = 0; i < walls.cells.size(); ++i) on.data[i] = walls.cells[i] ? 255 : 0;
  free_ = 255 - on;
  cv::Mat reached, wide_walls;
  cv::dilate(free_, reached, disc(reach));
  cv::dilate(on, wide_walls, disc(reach));
  beyond_ = 255 - reached;
  at_edge_ = reached & wide_walls;
}

void BackgroundModel::compare_with_light(const formats::Image& picture) {
  const cv::Mat grey(picture.height, picture.width, CV_8U,
                     const_cast<std::uint8_t*>(picture.pixels.data()));
  const cv::Mat light = vision::estimate_background(grey, free_);
  share_.resize(picture.pixels.size());
  divide(picture.pixels, light.ptr<float>(), share_.data());
}

const formats::Image& BackgroundModel::take_out(const formats::Image& picture) {
  compare_with_light(picture);
  if (background_.empty()) {
    background_.assign(share_.size(), 1.0F);
    for (std::size_t i = 0; i < share_.size(); ++i)
      if (at_edge_.data[i]) background_[i] = share_[i];
  }
  open_.width = picture.width;
  open_.height = picture.height;
  open_.pixels.resize(picture.pixels.size());
  level_out(share_, background_.data(), beyond_.data, open_.pixels.data());
  return open_;
}

bool BackgroundModel::is_dark(Vec2 at_px) const {
  const auto column = static_cast<int>(std::lround(at_px.x));
  const auto row = static_cast<int>(std::lround(at_px.y));
  if (column < 0 || row < 0 || column >= open_.width || row >= open_.height) return false;
  return open_.pixels[open_.index(column, row)] < dark * level;
}

void BackgroundModel::learn(std::span<const Vec2> robots) {
  cv::Mat empty(open_.height, open_.width, CV_8U, cv::Scalar(255));
  for (const Vec2 robot : robots)
    cv::circle(empty,
               {static_cast<int>(std::lround(robot.x)), static_cast<int>(std::lround(robot.y))},
               reach_ + 1, 0, cv::FILLED);
  approach(share_, empty.data, background_.data());
}

}  // namespace microswarm::rig
