// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/field_response.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "microswarm/actuation/field/waveform.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::rig {
namespace {

constexpr double rolling_inertia = 0.02;  // [s] response time of a body
constexpr double turn_inertia = 0.1;      // [s] over which turns are averaged
constexpr double reversal_inertia = 0.5;  // [s] the same for a field that reverses
constexpr double flat_pitch = 1e-3;       // [rad] a smaller pitch defines no heading

}  // namespace

Command FieldResponse::step(const Eigen::Vector3d& field, double dt) {
  const Eigen::Vector3d from = before_;
  before_ = field;
  Command motion = driven(from, field, dt);
  if (params_.step_out) motion.speed *= followed_share(from, field, dt);
  if (params_.heading_offset != 0) motion.heading += params_.heading_offset;
  return params_.delay > 0 ? delayed(motion, dt) : motion;
}

Command FieldResponse::driven(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dt) {
  if (from.norm() < params_.min_amplitude || to.norm() < params_.min_amplitude) {
    turn_.clear();
    return {heading_, 0};
  }
  switch (params_.kind) {
    case actuation::FieldKind::rolling:
      return rolling(from, to, dt);
    case actuation::FieldKind::rotating:
      return rotating(from, to, dt);
    case actuation::FieldKind::oscillating:
      return oscillating(to, dt);
  }
  return {};
}

/// Share of the field's turns that the body follows.
double FieldResponse::followed_share(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                     double dt) {
  const double product = from.norm() * to.norm();
  const bool oscillates = params_.kind == actuation::FieldKind::oscillating;
  const double angle =
      product > 0 ? maths::atan2(from.cross(to).norm(), from.dot(to)) : 0;  // [rad]
  const double inertia = oscillates ? reversal_inertia : turn_inertia;
  if (dt > 0) turn_rate_ += std::min(1.0, dt / inertia) * (angle / dt - turn_rate_);
  const double f = turn_rate_ / (2 * pi), most = *params_.step_out;
  return f > most ? (f - std::sqrt(f * f - most * most)) / f : 1;
}

/// The motion of `delay` ago.
Command FieldResponse::delayed(const Command& command, double dt) {
  later_.push_back({t_ + params_.delay, command});
  t_ += dt;
  while (later_.size() > 1 && later_[1].t <= t_ - dt + 1e-9) later_.pop_front();
  return later_.front().t <= t_ - dt + 1e-9 ? later_.front().command : Command{command.heading, 0};
}

Command FieldResponse::rolling(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dt) {
  const Vec2 rolled = actuation::rolled_distance(from, to, params_.length_per_turn);
  const Eigen::Vector3d sum = over({dt, {rolled.x, rolled.y, 0}}, rolling_inertia);
  double time = 0;
  for (const Piece& piece : turn_) time += piece.dt;
  const Command driven = command_for({sum.x(), sum.y()}, time);
  if (driven.speed > 0) heading_ = driven.heading;
  return {heading_, driven.speed};
}

/// Uses the normal of the plane of rotation in Eq 1 [radar], which points down at pitch 0.
Command FieldResponse::rotating(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dt) {
  return pitched(-over({dt, from.cross(to)}, 1 / params_.frequency));
}

Command FieldResponse::oscillating(const Eigen::Vector3d& field, double dt) {
  const Eigen::Vector3d along =
      over({dt, field.dot(axis_) < 0 ? -field : field}, 1 / params_.frequency);
  axis_ = along.normalized();
  const Vec2 flat{axis_.x(), axis_.y()};
  const double pitch = maths::asin(std::clamp(axis_.z(), -1.0, 1.0));
  const double sign = pitch < 0 ? -1 : 1;  // the forward direction is where the axis rises
  if (std::abs(pitch) > flat_pitch) heading_ = heading_along(sign * flat);
  return {heading_, params_.speed_per_pitch * std::abs(pitch)};
}

/// `raised` points upwards, tilted towards the heading by the pitch.
Command FieldResponse::pitched(const Eigen::Vector3d& raised) {
  const Vec2 flat{raised.x(), raised.y()};
  const double pitch = maths::atan2(norm(flat), std::abs(raised.z()));
  if (pitch > flat_pitch) heading_ = heading_along(flat);
  return {heading_, params_.speed_per_pitch * pitch};
}

Eigen::Vector3d FieldResponse::over(const Piece& piece, double last) {
  turn_.push_back(piece);
  double time = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Piece& p : turn_) {
    time += p.dt;
    sum += p.sum;
  }
  for (; turn_.size() > 1 && time > last + 1e-9; turn_.pop_front()) {
    time -= turn_.front().dt;
    sum -= turn_.front().sum;
  }
  return sum;
}

}  // namespace microswarm::rig
