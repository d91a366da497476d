// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "microswarm/navigation/prediction/motion_trail.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/navigation/prediction/oscillation.hpp"

namespace microswarm {

/// To and fro, or round, on a circle.
struct ArcSwing {
  Vec2 centre;
  double radius = 0;  ///< [µm]
  Oscillation way;    ///< x: along the circle from the heading 0 [µm]

  double angle(double t) const { return way.at(t).x / radius; }
  Vec2 at(double t) const { return centre + radius * unit_vector(angle(t)); }
};

/// How a body may go on, as several models that know nothing of one another take it: straight; with
/// the present acceleration, for a second; swinging on a line or ellipse; swinging on a circle,
/// both told from the newest 1.2, 3 and 8 s; as it once went on from here.
class MotionModels {
 public:
  static constexpr std::size_t windows = OscillationFit::windows.size();
  static constexpr std::size_t straight = 0;
  static constexpr std::size_t curved = 1;
  static constexpr std::size_t swing = 2;
  static constexpr std::size_t arc = swing + windows;
  static constexpr std::size_t again = arc + windows;
  static constexpr std::size_t count = again + 1;

  MotionModels();

  /// Takes what is known of the body, its newest sighting being the trail's last point. `seen` has
  /// the sightings that `fit` takes; empty: no swing is looked for.
  void fit(const MotionTrail& trail, const TrackedBody& motion, std::span<const Sighting> seen,
           OscillationFit& fit);
  /// Does the model have an opinion, and explain the newest sightings?
  bool holds(std::size_t model) const { return holds_[model]; }
  /// Where the centre is `s` seconds after the newest sighting.
  Vec2 place(std::size_t model, const MotionTrail& trail, double s) const;
  /// How far the body has turned by then since the newest sighting [rad].
  double turn(std::size_t model, const MotionTrail& trail, double s) const;

 private:
  void fit_swings(std::span<const Sighting> seen, double noise, OscillationFit& fit);
  void fit_arcs(std::span<const Sighting> seen, double noise, OscillationFit& fit);

  TrackedBody motion_;
  double turn_rate_ = 0;  ///< [rad/s]
  bool turns_ = false;    ///< has it turned of late?
  std::array<bool, count> holds_{};
  std::array<Oscillation, windows> swings_;
  std::array<ArcSwing, windows> arcs_;
  Recurrence again_;
  std::vector<Sighting> along_;  ///< the circle
};

}  // namespace microswarm
