// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::actuation {

/// Rotating field of amplitude A [mT]; its plane is pitched by `pitch` towards `heading` [rad], and
/// `phase` is 2πft. Eq 1 [radar].
Eigen::Vector3d rotating_field(double amplitude, double pitch, double heading, double phase);

/// Field that rolls bodies on the floor towards `heading`. It rotates in the vertical plane through
/// the heading, over the top and forwards. With u across the heading and w up this is Eq 1
/// [global]. At phases that are multiples of 2π it points along the heading.
Eigen::Vector3d rolling_field(double amplitude, double heading, double phase);

/// Displacement [µm] of a body on the floor whose field turns from one direction to another. The
/// body follows the field by the shortest rotation ω, since a field cannot turn it about the
/// field's own axis, and rolls by ω × up; `length_per_turn` [µm] is the distance per turn.
Vec2 rolled_distance(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                     double length_per_turn);

/// Field in the plane along `heading`, in which steering starts and ends: Eq 2 [global].
Eigen::Vector3d steering_field(double amplitude, double heading);

/// Field that oscillates along `heading`, raised out of the plane by `pitch`. [drrt] uses 16 Hz and
/// 10 mT in the plane.
Eigen::Vector3d oscillating_field(double amplitude, double pitch, double heading, double phase);

/// Settings of rolling fields: [global] uses 3 mT, [gather] 5 Hz.
struct RollingParams {
  double amplitude = 3;
  double frequency = 1;
  double steering_rate = radians(90);
  double length_per_turn = 1000;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.amplitude, mt("amplitude", 1e-6, 1e4, "Flux density."));
    visit(self.frequency, hz("frequency", 1e-6, 1e4, "Turns per second while rolling."));
    visit(self.steering_rate,
          deg_per_s("steering_rate", 1e-3, 1e5, "Maximum rate of change of the heading."));
    visit(self.length_per_turn,
          um("length_per_turn", 1e-3, 1e7, "Distance per turn: π times the diameter."));
  }
};

/// One straight move of a plan.
struct Move {
  double heading = 0;  ///< [rad]
  double length = 0;   ///< [µm]
};

/// One piece of a waveform: steers from one heading to another, or rolls whole turns.
struct WaveformPiece {
  double start = 0;  ///< [s]
  double duration = 0;
  double heading = 0;  ///< at the start [rad]
  double turn = 0;     ///< change of the heading [rad]
  int rolls = 0;       ///< number of whole turns
};

/// A field over time, continuous from start to end. It is constant before and after.
class Waveform {
 public:
  Waveform(double amplitude, std::vector<WaveformPiece> pieces)
      : amplitude_(amplitude), pieces_(std::move(pieces)) {}

  /// Time from the first piece to the end of the last [s].
  double duration() const {
    return pieces_.empty() ? 0 : pieces_.back().start + pieces_.back().duration;
  }
  const std::vector<WaveformPiece>& pieces() const { return pieces_; }
  /// Field [mT] at any time [s].
  Eigen::Vector3d at(double t) const;
  /// Field at 0, 1/rate, 2/rate, … up to the end; `rate` in Hz.
  std::vector<Eigen::Vector3d> sample(double rate) const;

 private:
  double amplitude_;
  std::vector<WaveformPiece> pieces_;
};

/// Waveform of a plan.
struct RollingPlan {
  Waveform waveform;
  std::vector<int> rolls{};  ///< whole turns of each move, rounded from its length
};

/// Converts consecutive moves to one waveform. Each move steers by the shorter rotation, then rolls
/// a whole number of turns, so steering starts in the plane: Eq 1, 2 [global]. The field starts
/// along `heading`. A move shorter than half a turn does nothing.
RollingPlan rolling_plan(std::span<const Move> moves, double heading, const RollingParams& params);

}  // namespace microswarm::actuation
