// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/robot_perception.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/rig/perception/background_model.hpp"
#include "microswarm/rig/perception/walls_in_picture.hpp"
#include "microswarm/swarm/robots/robot_swarm.hpp"
#include "microswarm/world/connectivity/free_place.hpp"

namespace microswarm::rig {
namespace {

constexpr double speed_margin = 3;     // of the speed of a robot between two pictures
constexpr double longest_blink = 0.5;  // [s] unseen, after which a robot does not join a pile
constexpr double usual_time = 1.0;     // [s] typical time between pictures, for the stepper's grid

std::size_t nearest_index(std::span<const Vec2> positions, Vec2 to) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < positions.size(); ++i)
    if (squared_norm(positions[i] - to) < squared_norm(positions[best] - to)) best = i;
  return best;
}

}  // namespace

RobotPerception::RobotPerception(const PerceptionParams& params, const RobotSwarmParams& robots,
                                 const Map& map, std::span<const Vec2> starts,
                                 const CameraView& view)
    : scale_(view.scale),
      map_(map),
      stepper_(map, robots.max_speed * usual_time),
      contact_(robots.contact),
      max_speed_(robots.max_speed),
      finder_(params.robots),
      diameter_(2 * finder_.radius_px() * scale_.um_per_px),
      min_seen_(params.min_seen_robots),
      background_(std::make_unique<BackgroundModel>(
          walls_in_picture(map, view.scale, view.width, view.height), finder_.radius_px())) {
  detections_.robots.assign(starts.begin(), starts.end());
}

RobotPerception::~RobotPerception() = default;

void RobotPerception::commanded(const Command& command, double) { command_ = command; }

const Detections& RobotPerception::process(const formats::Image& picture, double t) {
  find_spots(picture);
  if (detections_.robots.empty()) detections_.robots = spots_;
  const std::size_t count = detections_.robots.size();
  if (seen_at_.size() != count) seen_at_.assign(count, t);
  const double passed = std::max(0.0, t - seen_);
  seen_ = t;
  detections_.swarm.reset();
  detections_.not_found = NotFound::none;
  detections_.unseen = static_cast<int>(count);
  detections_.commanded = {};
  detections_.commanded_distance = detections_.followed_distance = detections_.across_distance = 0;
  expect(passed);
  if (spots_.empty()) return detections_;
  const double reach = diameter_ + speed_margin * max_speed_ * passed;
  pair(reach);
  place_the_unpaired(t, reach);
  measure_following();
  learn_ground();
  const double share = 1 - static_cast<double>(detections_.unseen) / static_cast<double>(count);
  detections_.not_found = NotFound::robots;
  if (share < min_seen_) return detections_;
  detections_.not_found.reset();
  detections_.swarm = enclosing_pose(detections_.robots, command_.heading);
  return detections_;
}

void RobotPerception::find_spots(const formats::Image& picture) {
  spots_.clear();
  for (const vision::Particle& particle : finder_.find(background_->take_out(picture)))
    spots_.push_back(scale_.to_world(particle.at_px));
}

/// Predicts the robots' positions from the command and the walls.
void RobotPerception::expect(double passed) {
  std::vector<Vec2>& positions = detections_.robots;
  before_ = positions;
  for (Vec2& position : positions) position = free_place(map_, position, 2 * stepper_.guard());
  Robots robots = stepper_.place(positions);
  stepper_.step(robots, displacement(command_, passed), contact_);
  positions = robots.positions();
  expected_ = positions;
}

void RobotPerception::pair(double reach) {
  const std::vector<Vec2>& robots = detections_.robots;
  edges_.clear();
  // Sort by x, so that only spots of similar x are compared.
  std::vector<int> by_x(spots_.size());
  std::iota(by_x.begin(), by_x.end(), 0);
  const auto x_at = [&](int spot) { return spots_[static_cast<std::size_t>(spot)].x; };
  std::sort(by_x.begin(), by_x.end(), [&](int a, int b) { return x_at(a) < x_at(b); });
  for (std::size_t r = 0; r < robots.size(); ++r) {
    auto at = std::partition_point(by_x.begin(), by_x.end(),
                                   [&](int s) { return x_at(s) < robots[r].x - reach; });
    for (; at != by_x.end() && x_at(*at) <= robots[r].x + reach; ++at) {
      const double d = squared_norm(spots_[static_cast<std::size_t>(*at)] - robots[r]);
      if (d <= reach * reach) edges_.push_back({static_cast<int>(r), *at, d});
    }
  }
  spot_of_ = assignment_.solve(static_cast<int>(robots.size()), static_cast<int>(spots_.size()),
                               edges_, reach * reach);
}

/// Maximum distance from its expected position of a robot that was not seen for some time [µm].
double RobotPerception::robot_reach(std::size_t robot, double t) const {
  return diameter_ + speed_margin * max_speed_ * (t - seen_at_[robot]);
}

void RobotPerception::place_the_unpaired(double t, double reach) {
  std::vector<Vec2>& robots = detections_.robots;
  std::vector<bool> taken(spots_.size());
  std::vector<std::size_t> left;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    if (!spot_of_[r]) {
      left.push_back(r);
      continue;
    }
    const auto spot = static_cast<std::size_t>(*spot_of_[r]);
    robots[r] = spots_[spot];
    taken[spot] = true;
    seen_at_[r] = t;
  }
  for (std::size_t s = 0; s < spots_.size() && !left.empty(); ++s) {
    if (taken[s]) continue;
    const auto nearest =
        std::min_element(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
          return squared_norm(robots[a] - spots_[s]) < squared_norm(robots[b] - spots_[s]);
        });
    if (distance(robots[*nearest], spots_[s]) > robot_reach(*nearest, t)) continue;
    robots[*nearest] = spots_[s];
    seen_at_[*nearest] = t;
    left.erase(nearest);
  }
  detections_.unseen = 0;
  for (const std::size_t r : left) {
    const Vec2 spot = spots_[nearest_index(spots_, robots[r])];
    const bool is_dark = background_->is_dark(scale_.to_picture(robots[r]));
    const bool joins = is_dark || distance(robots[r], spot) <= reach;
    if (!joins || t - seen_at_[r] > longest_blink) {
      ++detections_.unseen;
      continue;
    }
    if (!is_dark) robots[r] = spot;
    seen_at_[r] = t;
  }
}

/// Compares the motion of the robots with separate spots with the expected one.
void RobotPerception::measure_following() {
  double count = 0;
  for (std::size_t r = 0; r < before_.size(); ++r) {
    const Vec2 wanted = expected_[r] - before_[r];
    const double length = norm(wanted);
    if (!spot_of_[r] || length == 0) continue;
    ++count;
    detections_.commanded = detections_.commanded + wanted;
    detections_.commanded_distance += length;
    const Vec2 seen = detections_.robots[r] - before_[r];
    detections_.followed_distance += dot(seen, wanted) / length;
    detections_.across_distance += cross(wanted, seen) / length;
  }
  if (count == 0) return;
  detections_.commanded = (1 / count) * detections_.commanded;
  detections_.commanded_distance /= count;
  detections_.followed_distance /= count;
  detections_.across_distance /= count;
}

void RobotPerception::learn_ground() {
  std::vector<Vec2> at_px;
  for (const Vec2 robot : detections_.robots) at_px.push_back(scale_.to_picture(robot));
  for (const Vec2 spot : spots_) at_px.push_back(scale_.to_picture(spot));
  background_->learn(at_px);
}

}  // namespace microswarm::rig
