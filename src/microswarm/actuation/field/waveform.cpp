// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/field/waveform.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::actuation {

Eigen::Vector3d rotating_field(double amplitude, double pitch, double heading, double phase) {
  const auto [across, along] = maths::sincos(phase);
  const auto [up, level] = maths::sincos(pitch);
  const Vec2 ahead = unit_vector(heading);
  return amplitude * Eigen::Vector3d(-level * ahead.x * along - ahead.y * across,
                                     -level * ahead.y * along + ahead.x * across, up * along);
}

Eigen::Vector3d rolling_field(double amplitude, double heading, double phase) {
  const auto [down, forward] = maths::sincos(phase);
  const Vec2 ahead = unit_vector(heading);
  return amplitude * Eigen::Vector3d(forward * ahead.x, forward * ahead.y, -down);
}

Vec2 rolled_distance(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                     double length_per_turn) {
  const Eigen::Vector3d axis = from.cross(to);
  const double sine = axis.norm();
  if (sine == 0) return {};
  const Eigen::Vector3d turn = maths::atan2(sine, from.dot(to)) / sine * axis;
  return length_per_turn / (2 * pi) * Vec2{turn.y(), -turn.x()};
}

Eigen::Vector3d steering_field(double amplitude, double heading) {
  const Vec2 ahead = unit_vector(heading);
  return amplitude * Eigen::Vector3d(ahead.x, ahead.y, 0);
}

Eigen::Vector3d oscillating_field(double amplitude, double pitch, double heading, double phase) {
  const auto [up, level] = maths::sincos(pitch);
  const Vec2 ahead = unit_vector(heading);
  return amplitude * maths::cos(phase) * Eigen::Vector3d(level * ahead.x, level * ahead.y, up);
}

Eigen::Vector3d Waveform::at(double t) const {
  if (pieces_.empty()) return Eigen::Vector3d::Zero();
  const auto after =
      std::upper_bound(pieces_.begin(), pieces_.end(), t,
                       [](double time, const WaveformPiece& piece) { return time < piece.start; });
  const WaveformPiece& piece = after == pieces_.begin() ? *after : *(after - 1);
  const double share =
      piece.duration > 0 ? std::clamp((t - piece.start) / piece.duration, 0.0, 1.0) : 1;
  if (piece.rolls > 0)
    return rolling_field(amplitude_, piece.heading, 2 * pi * piece.rolls * share);
  return steering_field(amplitude_, piece.heading + share * piece.turn);
}

std::vector<Eigen::Vector3d> Waveform::sample(double rate) const {
  assert(rate > 0);
  std::vector<Eigen::Vector3d> fields;
  const auto count = static_cast<std::size_t>(std::floor(duration() * rate)) + 1;
  for (std::size_t i = 0; i < count; ++i) fields.push_back(at(static_cast<double>(i) / rate));
  return fields;
}

RollingPlan rolling_plan(std::span<const Move> moves, double heading, const RollingParams& params) {
  std::vector<WaveformPiece> pieces{{0, 0, heading, 0, 0}};
  std::vector<int> rolls;
  double now = 0;
  for (const Move& move : moves) {
    rolls.push_back(static_cast<int>(std::lround(move.length / params.length_per_turn)));
    if (rolls.back() <= 0) {
      rolls.back() = 0;
      continue;
    }
    const double turn = wrap(move.heading - heading);
    if (turn != 0) {
      const double duration = std::abs(turn) / params.steering_rate;
      pieces.push_back({now, duration, heading, turn, 0});
      now += duration;
    }
    heading = move.heading;
    const double duration = rolls.back() / params.frequency;
    pieces.push_back({now, duration, heading, 0, rolls.back()});
    now += duration;
  }
  return {Waveform(params.amplitude, std::move(pieces)), std::move(rolls)};
}

}  // namespace microswarm::actuation
