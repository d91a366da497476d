// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/robot_eye.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "microswarm/rig/walls_in_picture.hpp"

namespace microswarm {

RobotEye::RobotEye(const EyeParams& params, const RobotSwarmParams& robots, const Map& map,
                   std::span<const Vec2> starts, const CameraView& view)
    : scale_(view.scale),
      walls_(walls_in_picture(map, view.scale, view.width, view.height)),
      finder_(params.robots),
      max_speed_(robots.max_speed) {
  sight_.robots.assign(starts.begin(), starts.end());
}

void RobotEye::commanded(const Command& command, double) { command_ = command; }

const Sight& RobotEye::see(const Image& picture, double t) {
  std::vector<Vec2> spots;
  hide_walls(picture);
  for (const Particle& particle : finder_.find(open_))
    spots.push_back(scale_.to_world(particle.at_px));
  if (sight_.robots.empty()) sight_.robots = spots;
  if (sight_.robots.empty()) {
    sight_.trouble = "none";
    return sight_;
  }
  const double passed = std::max(0.0, t - seen_);
  seen_ = t;
  // Half of where the command would take it: it may do so, or be held by a wall.
  for (Vec2& robot : sight_.robots) robot += 0.5 * displacement(command_, passed);
  const double diameter = 2 * finder_.radius_px() * scale_.um_per_px;
  if (!spots.empty()) pair(spots, diameter + 3 * max_speed_ * passed);
  Vec2 sum{};
  for (const Vec2 robot : sight_.robots) sum += robot;
  const double n = static_cast<double>(sight_.robots.size());
  const Vec2 middle = sum / n;
  double squares = 0;
  for (const Vec2 robot : sight_.robots) squares += squared_norm(robot - middle);
  sight_.swarm.reset();
  sight_.trouble = spots.empty() ? "none" : "";
  if (!spots.empty()) sight_.swarm = {{middle, command_.heading}, std::sqrt(squares / n)};
  return sight_;
}

/// Walls get the mean grey of what is free around them, so that their edges are no robots.
void RobotEye::hide_walls(const Image& picture) {
  open_ = picture;
  const int side = 4 * finder_.radius_px() + 1;
  cv::Mat grey(picture.height, picture.width, CV_8U, open_.pixels.data());
  const cv::Mat walls(walls_.height, walls_.width, CV_8U, walls_.cells.data());
  cv::Mat free, sum, around;
  free = walls == 0;
  cv::Mat masked = cv::Mat::zeros(grey.size(), CV_32F);
  grey.convertTo(masked, CV_32F);
  masked.setTo(0, walls);
  cv::boxFilter(masked, sum, CV_32F, {side, side}, {-1, -1}, false);
  cv::boxFilter(free, around, CV_32F, {side, side}, {-1, -1}, false);
  cv::divide(sum, cv::max(around, 1), sum, 255);
  const double ground = cv::mean(grey, free)[0];
  sum.setTo(ground, around < 1);
  sum.convertTo(masked, CV_8U);
  masked.copyTo(grey, walls);
}

void RobotEye::pair(const std::vector<Vec2>& spots, double reach) {
  std::vector<Vec2>& robots = sight_.robots;
  edges_.clear();
  // In order of x, so that only spots of about the same x are compared.
  std::vector<int> by_x(spots.size());
  for (std::size_t i = 0; i < by_x.size(); ++i) by_x[i] = static_cast<int>(i);
  std::sort(by_x.begin(), by_x.end(), [&](int a, int b) { return spots[a].x < spots[b].x; });
  for (std::size_t r = 0; r < robots.size(); ++r) {
    auto at = std::partition_point(by_x.begin(), by_x.end(),
                                   [&](int s) { return spots[s].x < robots[r].x - reach; });
    for (; at != by_x.end() && spots[*at].x <= robots[r].x + reach; ++at)
      if (const double d = squared_norm(spots[*at] - robots[r]); d <= reach * reach)
        edges_.push_back({static_cast<int>(r), *at, d});
  }
  const auto& spot_of = assignment_.solve(static_cast<int>(robots.size()),
                                          static_cast<int>(spots.size()), edges_, reach * reach);
  // A spot that is left over is a robot that was taken to be elsewhere: of those in a pile.
  for (std::size_t r = 0; r < robots.size(); ++r) {
    if (spot_of[r]) {
      robots[r] = spots[static_cast<std::size_t>(*spot_of[r])];
      continue;
    }
    const auto nearest = std::min_element(spots.begin(), spots.end(), [&](Vec2 a, Vec2 b) {
      return squared_norm(a - robots[r]) < squared_norm(b - robots[r]);
    });
    robots[r] = *nearest;
  }
}

}  // namespace microswarm
