// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/microscope.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/rig/perception/walls_in_picture.hpp"
#include "microswarm/vision/image/blur.hpp"

namespace microswarm::rig {
namespace {

constexpr int max_side = 4096;                  // [px]
constexpr double usual_side = 800;              // [px]
constexpr std::size_t grains = 1 << 18;         // precomputed noise values
constexpr std::size_t max_particles = 1 << 15;  // of a swarm
constexpr int corner_bits = 4;                  // sub-pixel bits of polygon corners in OpenCV
constexpr double swarm_spin = 0.5;              // [rad/s]; makes every picture different

cv::Mat as_floats(std::vector<float>& values, int width, int height) {
  return {height, width, CV_32F, values.data()};
}

MICROSWARM_EACH_CPU void expose_pixels(float light, const float* lamp, const float* view,
                                       const float* grain, std::uint8_t* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const float grey = light * lamp[i] * view[i] + grain[i] + 0.5F;
    const float least = grey > 0.0F ? grey : 0.0F;
    out[i] = static_cast<std::uint8_t>(static_cast<int>(least < 255.0F ? least : 255.0F));
  }
}

}  // namespace

Microscope::Microscope(const MicroscopeParams& params, const Map& map, std::uint64_t seed,
                       std::uint32_t trial)
    : params_(params), rng_(seed, Purpose::sensor, trial) {
  const Box& seen = map.bounds();
  const double cell = params.um_per_px.value_or(std::max(seen.width(), seen.height()) / usual_side);
  const auto pixels = [&](double length) {
    const double n = std::ceil(length / cell - 1e-9) + 2 * params.margin;
    if (!(n <= max_side))
      throw InputError(
          fmt::format("um_per_px is {:.6g}: the picture would be {:.6g} pixels long, "
                      "at most {} are drawn",
                      cell, n, max_side));
    return static_cast<int>(n);
  };
  width_ = pixels(seen.width());
  height_ = pixels(seen.height());
  scale_ = vision::upright_scale(height_ - params.margin, cell);
  scale_.origin_px += Vec2{static_cast<double>(params.margin), 0};
  scale_.origin_px = scale_.to_picture(-seen.lo);
  drawn_ = scale_;
  ground_ = ground_of(map, scale_);
  const std::size_t size = ground_.size();
  if (params.shift_px != Vec2{} || params.turn != 0 || params.scale_error != 0)
    moved_ground_ = ground_of(map, moved_scale());
  lamp_.reserve(size);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const double across = (x + 0.5) / width_ + (y + 0.5) / height_ - 1;
      lamp_.push_back(static_cast<float>(params.light * (1 + params.light_gradient * across)));
    }
  grain_.reserve(grains);
  for (std::size_t i = 0; i < grains; ++i)
    grain_.push_back(static_cast<float>(params.noise * rng_.normal()));
  particles_.reserve(max_particles);
  for (std::size_t i = 0; i < max_particles; ++i) {
    const double r = std::sqrt(rng_.uniform());
    particles_.push_back(r * unit_vector(rng_.uniform(-pi, pi)));
  }
  picture_ = {width_, height_, 1, std::vector<std::uint8_t>(size)};
}

/// Shares of the light that pass the map's walls.
std::vector<float> Microscope::ground_of(const Map& map, const vision::CameraScale& scale) const {
  const formats::Mask walls = walls_in_picture(map, scale, width_, height_);
  std::vector<float> ground;
  ground.reserve(walls.cells.size());
  for (const std::uint8_t wall : walls.cells)
    ground.push_back(static_cast<float>(wall ? 1 - params_.wall_depth : 1));
  return ground;
}

/// The scale with shift, turn and scale error about the picture's middle.
vision::CameraScale Microscope::moved_scale() const {
  const Vec2 middle{0.5 * (width_ - 1), 0.5 * (height_ - 1)};
  vision::CameraScale moved = scale_;
  moved.um_per_px /= 1 + params_.scale_error;
  moved.rotation += params_.turn;
  moved.origin_px = middle + params_.shift_px +
                    (1 + params_.scale_error) * rotated(scale_.origin_px - middle, params_.turn);
  return moved;
}

const formats::Image& Microscope::look(const Snapshot& world, const std::optional<SwarmPose>& swarm,
                                       std::span<const Vec2> robots, std::optional<double> t) {
  const double now = t.value_or(world.time());
  if (params_.frozen_after && now >= *params_.frozen_after && !view_.empty()) {
    expose(world.time());
    return picture_;
  }
  if (!moved_ground_.empty() && now >= params_.moved_after) {
    ground_ = std::exchange(moved_ground_, {});
    drawn_ = moved_scale();
  }
  view_ = ground_;
  for (const Body& body : world.moving().bodies()) draw_body(body);
  if (swarm) draw_swarm({{swarm->pose.position, swarm_spin * world.time()}, swarm->radius});
  for (const Vec2 robot : robots)
    draw_disc(drawn_.to_picture(robot), 0.5 * params_.robot_diameter, params_.swarm_depth);
  if (params_.blur > 0) {
    cv::Mat view = as_floats(view_, width_, height_);
    vision::blurred(view, params_.blur).copyTo(view);
  }
  expose(world.time());
  return picture_;
}

void Microscope::draw_body(const Body& body) {
  std::visit(Overloaded{[&](const Disc& disc) {
                          draw_disc(drawn_.to_picture(disc.centre), disc.radius / drawn_.um_per_px,
                                    params_.obstacle_depth);
                        },
                        [&](const Polygon& polygon) { draw_polygon(polygon); }},
             body.shape);
}

void Microscope::draw_polygon(const Polygon& polygon) {
  std::vector<std::vector<cv::Point>> rings;
  const auto add = [&](const std::vector<Vec2>& ring) {
    std::vector<cv::Point>& corners = rings.emplace_back();
    corners.reserve(ring.size());
    for (const Vec2 p : ring) {
      const Vec2 at = (1 << corner_bits) * drawn_.to_picture(p);
      corners.emplace_back(static_cast<int>(std::lround(at.x)),
                           static_cast<int>(std::lround(at.y)));
    }
  };
  add(polygon.outer);
  for (const auto& hole : polygon.holes) add(hole);
  cv::Mat covered = cv::Mat::zeros(height_, width_, CV_8U);
  cv::fillPoly(covered, rings, 255, cv::LINE_AA, corner_bits);
  for (std::size_t i = 0; i < view_.size(); ++i)
    view_[i] *= static_cast<float>(1 - params_.obstacle_depth * covered.data[i] / 255);
}

void Microscope::draw_swarm(const SwarmPose& swarm) {
  const double grain = 0.5 * params_.particle_diameter;
  const double reach = std::max(0.0, swarm.radius / drawn_.um_per_px - grain);
  const Vec2 middle = drawn_.to_picture(swarm.pose.position);
  const Vec2 turn = unit_vector(swarm.pose.heading);
  const double clumps = params_.swarm_density * reach * reach / (grain * grain);
  const std::size_t count = std::min(max_particles, static_cast<std::size_t>(clumps) + 1);
  for (const Vec2 p : std::span(particles_).first(count))
    draw_disc(middle + reach * Vec2{p.x * turn.x - p.y * turn.y, p.x * turn.y + p.y * turn.x},
              grain, params_.swarm_depth);
}

/// Draws a disc with an edge one pixel soft.
void Microscope::draw_disc(Vec2 at, double radius, double depth) {
  const int left = std::max(0, static_cast<int>(std::floor(at.x - radius - 1)));
  const int right = std::min(width_ - 1, static_cast<int>(std::ceil(at.x + radius + 1)));
  const int top = std::max(0, static_cast<int>(std::floor(at.y - radius - 1)));
  const int bottom = std::min(height_ - 1, static_cast<int>(std::ceil(at.y + radius + 1)));
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const double off = norm(Vec2{x - at.x, y - at.y});
      const double covered = std::clamp(radius - off + 0.5, 0.0, 1.0);
      view_[picture_.index(x, y)] *= static_cast<float>(1 - depth * covered);
    }
}

void Microscope::expose(double t) {
  const double swell = params_.light_drift * maths::sin(2 * pi * t / params_.light_period);
  const auto light = static_cast<float>(1 + swell);
  std::size_t grain = rng_.below(grains);
  for (std::size_t i = 0; i < view_.size(); grain = 0) {
    const std::size_t count = std::min(view_.size() - i, grains - grain);
    expose_pixels(light, &lamp_[i], &view_[i], &grain_[grain], &picture_.pixels[i], count);
    i += count;
  }
}

}  // namespace microswarm::rig
