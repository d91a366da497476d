// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>

#include "microswarm/contracts/diagnostics.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::navigation {

/// Input of one radar decision, besides the world. Lengths in µm.
struct RadarLook {
  Vec2 centre{};                 ///< of the swarm, O_s
  double radius = 0;             ///< of the swarm, r_s
  Vec2 target{};                 ///< O_t
  RadarCircles circles{};        ///< with the controlled r_f of Eq 24
  double step = 0;               ///< d_p
  double wall_distance = 0;      ///< d_f of walls and border, Eq 30, independent of r_f
  double approach = 0;           ///< reduction of the distances to obstacles
  double target_gain = 0;        ///< k_t ε
  double avoidance_gain = 0;     ///< k_a η
  bool printed_weights = false;  ///< Eq 10 and 12 with centre distances
  std::optional<Vec2> course{};  ///< unit vector of the last commanded direction
  double min_cosine = -1;        ///< of the angle to it, if there is a choice

  /// Distance [µm] that a predictive swarm's centre keeps from obstacles: r_s + d_f + `approach`.
  double obstacle_reach() const { return circles.safety - step + approach; }
  /// The same for walls and border [µm].
  double wall_reach() const { return radius + wall_distance; }
};

/// Weights for an obstacle whose edge is `distance` µm from the swarm's centre. As printed, the
/// scale of Q_a is 0 for an obstacle exactly as wide as the room left by the circle, and Q_a grows
/// again inside the circle. Measured from the obstacle's edge, between the swarm's and the
/// detection circle, both are well-defined: q_a = 1/2 + k_a η / 2 · ((1/s − 1/r_d) / (1/r_s −
/// 1/r_d))². Hence q_t >= 1 > q_a for k_a η < 1.
/// With `printed_weights` Eq 10 and 12 are taken literally, s from centre to centre and r_s + r_ob
/// in place of r_s, for an obstacle whose centre is `obstacle_radius` µm behind its edge. The paper
/// demands of k_a that q_t stays larger than q_a: q_a is at most q_t.
RadarWeights radar_weights(const RadarLook& look, double distance, double obstacle_radius = 0);

/// r_ob of Eq 10 if the weights are the printed ones, else 0: how far the centre of a body's
/// enclosing disc is behind its edge, seen from the swarm [µm]; a disc's radius.
double obstacle_radius(const RadarLook& look, const Body& body);

/// Lower bound of the distance ‖O_pe O_t‖ in Eq 9 [µm].
inline constexpr double min_distance = 1e-9;

/// N(·) of Eq 9 [radar]: from 0 to 1 over the candidates, 0 if all are equal.
class MinMax {
 public:
  void include(double v) {
    min_ = v < min_ ? v : min_;
    max_ = v > max_ ? v : max_;
  }
  /// Reciprocal of the range; 0 if all are equal.
  double scale() const { return max_ > min_ ? 1 / (max_ - min_) : 0; }
  double normalised(double v) const { return (v - min_) * scale(); }

 private:
  double min_ = std::numeric_limits<double>::infinity();
  double max_ = -std::numeric_limits<double>::infinity();
};

/// Whether a direction keeps to the side of the course.
inline bool keeps_course(const RadarLook& look, Vec2 direction) {
  return !look.course || look.min_cosine <= -1 || dot(direction, *look.course) >= look.min_cosine;
}

/// Tests every direction against every body and wall: slow reference for RadarScanner.
RadarDiagnostics scan(const RadarLook& look, const Snapshot& world, int directions);

/// O_ob of Eq 9 [radar]: the disc's centre or the polygon's centroid, so that along a flat face one
/// direction is better than the other. Nothing if the centroid is not inside the body, as in a
/// hollow one; then the distance to its edge counts.
std::optional<Vec2> rotation_centre(const Body& body);

}  // namespace microswarm::navigation
