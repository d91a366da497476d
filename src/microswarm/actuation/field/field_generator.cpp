// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/field/field_generator.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/actuation/field/waveform.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm::actuation {
namespace {

// In units of a turn's length. Missed displacement across the heading is made up over
// `catch_up_lengths`; faster turns would miss more than they make up. Displacement beyond
// `max_owed` is dropped. At most `max_rolled` is rolled per step, since half a turn has no
// direction.
constexpr double catch_up_lengths = 0.25, max_owed = 0.5, max_rolled = 0.4;
constexpr double max_haste = 2;  // times the commanded speed, while making up displacement

}  // namespace

FieldGenerator::FieldGenerator(const FieldGeneratorParams& params, double heading)
    : params_(params),
      heading_(heading - params.heading_offset),
      wanted_heading_(heading - params.heading_offset) {
  if (params.kind != FieldKind::rolling) frequency_ = params.frequency;
  update_field();
}

void FieldGenerator::command(const Command& command) {
  const double speed = std::max(command.speed, 0.0);
  const double heading = command.heading - params_.heading_offset;
  if (speed > 0) wanted_heading_ = heading;
  if (params_.kind == FieldKind::rolling) {
    velocity_ = std::min(speed, params_.max_speed()) * unit_vector(heading);
    if (speed == 0) owed_ = {};
  } else {
    wanted_pitch_ = std::min(speed / params_.speed_per_pitch, params_.max_pitch);  // Eq 2 [radar]
  }
}

const Eigen::Vector3d& FieldGenerator::advance(double dt) {
  if (params_.kind == FieldKind::rolling) {
    roll(dt);
    return field_;
  }
  turn_to(wanted_heading_, dt);
  const double lift = params_.max_pitch_rate * dt;
  pitch_ += std::clamp(wanted_pitch_ - pitch_, -lift, lift);
  phase_ = std::fmod(phase_ + 2 * pi * frequency_ * dt, 2 * pi);
  update_field();
  return field_;
}

void FieldGenerator::turn_to(double heading, double dt) {
  const double most = params_.max_turn_rate * dt;
  heading_ = wrap(heading_ + std::clamp(wrap(heading - heading_), -most, most));
}

// Rolls backwards if that is the shorter turn. The displacement of the turn itself counts as
// missed.
void FieldGenerator::roll(double dt) {
  const double length = params_.length_per_turn;
  owed_ += dt * velocity_;
  if (const double most = max_owed * length; norm(owed_) > most) owed_ = most / norm(owed_) * owed_;
  const double speed = norm(velocity_);
  if (speed > 0) {
    const double wanted = heading_along(owed_ + catch_up_lengths * length / speed * velocity_);
    const bool backwards = std::abs(wrap(wanted - heading_)) > pi / 2;
    turn_to(backwards ? wanted + pi : wanted, dt);
  }
  const double fastest = std::min(length * params_.frequency, max_haste * speed);
  const double most = std::min(fastest * dt, max_rolled * length);
  const double rolled = std::clamp(dot(owed_, unit_vector(heading_)), -most, most);
  frequency_ = dt > 0 ? rolled / length / dt : 0;
  phase_ = std::fmod(phase_ + 2 * pi * (1 + rolled / length), 2 * pi);
  const Eigen::Vector3d before = field_;
  update_field();
  owed_ -= rolled_distance(before, field_, length);
}

double FieldGenerator::max_rate() const {
  return params_.amplitude *
         (2 * pi * params_.frequency + params_.max_turn_rate + params_.max_pitch_rate);
}

TurningField FieldGenerator::turning() const { return {field_at(0), field_at(pi / 2)}; }

void FieldGenerator::follow_phase(double phase) {
  constexpr double share = 0.1;
  phase_ = std::fmod(phase_ + share * wrap(phase - phase_) + 2 * pi, 2 * pi);
}

void FieldGenerator::set_frequency(double frequency) {
  params_.frequency = frequency;
  if (params_.kind != FieldKind::rolling) frequency_ = frequency;
}

void FieldGenerator::update_field() { field_ = field_at(phase_); }

Eigen::Vector3d FieldGenerator::field_at(double phase) const {
  switch (params_.kind) {
    case FieldKind::rotating:
      return rotating_field(params_.amplitude, pitch_, heading_, phase);
    case FieldKind::rolling:
      return rolling_field(params_.amplitude, heading_, phase);
    case FieldKind::oscillating:
      return oscillating_field(params_.amplitude, pitch_, heading_, phase);
  }
  assert(false);
  return Eigen::Vector3d::Zero();
}

}  // namespace microswarm::actuation
