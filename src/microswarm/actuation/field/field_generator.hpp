// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "microswarm/contracts/command.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm::actuation {

/// Kind of field that drives the swarm: pitched and rotating [radar], rolling [gather], or
/// oscillating [drrt].
enum class FieldKind { rotating, rolling, oscillating };
constexpr auto enum_names(FieldKind) {
  return std::array<std::pair<FieldKind, std::string_view>, 3>{
      {{FieldKind::rotating, "rotating"},
       {FieldKind::rolling, "rolling"},
       {FieldKind::oscillating, "oscillating"}}};
}

/// Conversion of commands to a field. A speed becomes a pitch, speed = c · pitch (Eq 2 [radar]), or
/// for rolling fields a frequency, speed = length_per_turn · f.
struct FieldGeneratorParams {
  FieldKind kind = FieldKind::rotating;
  double amplitude = 8;
  double frequency = 16;
  double speed_per_pitch = 20 / radians(1);
  double max_pitch = radians(5);
  double length_per_turn = 20;
  double max_turn_rate = radians(360);
  double max_pitch_rate = radians(30);
  double heading_offset = 0;
  std::optional<double> step_out_frequency{};
  /// Largest speed that the field can be commanded [µm/s].
  double max_speed() const {
    return kind == FieldKind::rolling ? length_per_turn * frequency : speed_per_pitch * max_pitch;
  }
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.kind, plain("kind", "Kind of the field that drives the swarm."));
    visit(self.amplitude, mt("amplitude", 0, 1e3, "Flux density."));
    visit(self.frequency,
          hz("frequency", 1e-6, 1e4, "Turns per second; the maximum for rolling fields."));
    visit(self.speed_per_pitch,
          um_per_s("speed_per_pitch", 1e-6, 1e9, "Speed for a pitch of 1 rad, c of Eq 2 [radar]."));
    visit(self.max_pitch, deg("max_pitch", 0, 90, "Largest stable pitch."));
    visit(self.length_per_turn,
          um("length_per_turn", 1e-6, 1e6, "Distance per turn of a rolling field."));
    visit(self.max_turn_rate,
          deg_per_s("max_turn_rate", 1e-3, 1e6, "Maximum rate of change of the heading."));
    visit(self.max_pitch_rate,
          deg_per_s("max_pitch_rate", 1e-3, 1e6, "Maximum rate of change of the pitch."));
    visit(self.heading_offset,
          deg("heading_offset", -180, 180, "Swarm's direction against the field's heading."));
    visit(self.step_out_frequency,
          hz("step_out_frequency", 1e-6, 1e4, "Largest frequency that the swarm follows."));
  }
};

/// A field as a function of the phase φ: cosine cos φ + sine sin φ [mT].
struct TurningField {
  Eigen::Vector3d cosine{}, sine{};
};

/// Generates the field for a navigator's commands, at 10 Hz or any other rate. Phase, heading and
/// pitch are continuous, so the field never jumps: it changes by at most `max_rate()` · Δt. A
/// rolling field follows the commanded path if it can turn by 90° much faster than commands change.
/// The displacement missed while the heading turns, and the displacement of the turn itself, are
/// tracked and made up at up to twice the commanded speed. The tracked displacement is limited to
/// half of `length_per_turn`. The field rolls backwards rather than turn by more than 90°. The
/// field's heading is the commanded one less `heading_offset`.
class FieldGenerator {
 public:
  FieldGenerator(const FieldGeneratorParams& params, double heading);

  /// Sets the current command. Speed 0 takes the pitch or the frequency to 0 and keeps the heading;
  /// a rolling field also drops its tracked displacement.
  void command(const Command& command);
  /// Advances time by `dt` seconds; the field then [mT].
  const Eigen::Vector3d& advance(double dt);

  const Eigen::Vector3d& field() const { return field_; }
  /// The field at any phase, with heading and pitch as they are.
  TurningField turning() const;
  /// Moves the phase by a tenth of what it lacks to `phase` [rad], that of a device which turns the
  /// field by its own clock. A jump would disturb what a rolling field makes up.
  void follow_phase(double phase);
  /// Sets the turns per second, or their maximum for a rolling field [Hz]; the phase continues.
  void set_frequency(double frequency);
  double heading() const { return heading_; }      ///< of the field [rad]
  double pitch() const { return pitch_; }          ///< [rad]
  double phase() const { return phase_; }          ///< [rad], in [0, 2π)
  double frequency() const { return frequency_; }  ///< [Hz], negative when rolling backwards
  double max_frequency() const { return params_.frequency; }  ///< [Hz]
  /// Maximum rate of change of the field [mT/s].
  double max_rate() const;

 private:
  void turn_to(double heading, double dt);
  void roll(double dt);
  void update_field();
  Eigen::Vector3d field_at(double phase) const;

  FieldGeneratorParams params_;
  double heading_;
  double wanted_heading_;
  double pitch_ = 0;
  double wanted_pitch_ = 0;
  double phase_ = 0;
  double frequency_ = 0;
  Vec2 velocity_, owed_;  // rolling: commanded [µm/s], displacement to make up [µm]
  Eigen::Vector3d field_;
};

}  // namespace microswarm::actuation
