// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "microswarm/navigation/prediction/motion_models_tuning.hpp"
#include "microswarm/navigation/prediction/motion_trail.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/navigation/prediction/oscillation.hpp"

namespace microswarm::navigation {

/// Oscillation or rotation on a circle.
struct ArcSwing {
  Vec2 centre{};
  double radius = 0;         ///< [µm]
  Oscillation arc_length{};  ///< x: arc length from heading 0 [µm]

  /// Heading from the centre at `t` [rad].
  double angle(double t) const { return arc_length.at(t).x / radius; }
  Vec2 at(double t) const { return centre + radius * unit_vector(angle(t)); }
};

/// Independent predictions of a body's motion: straight; with the current acceleration for a
/// while; oscillating on a line or ellipse, and oscillating on a circle, both fitted to the newest
/// sightings in three windows; repeating a past motion from the same state.
class MotionModels {
 public:
  static constexpr std::size_t windows = OscillationFit::window_count;
  static constexpr std::size_t straight = 0;
  static constexpr std::size_t curved = 1;
  static constexpr std::size_t swing = 2;
  static constexpr std::size_t arc = swing + windows;
  static constexpr std::size_t again = arc + windows;
  static constexpr std::size_t count = again + 1;

  explicit MotionModels(const MotionModelsTuning& tuning = {},
                        const RecurrenceTuning& recurrence = {});

  /// Fits the models to the body, whose newest sighting is the trail's last point. `seen` holds the
  /// sightings used by `fit`; if empty, no oscillation is fitted.
  void fit(const MotionTrail& trail, const TrackedBody& motion, std::span<const Sighting> seen,
           OscillationFit& fit);
  /// Whether the model applies and explains the newest sightings.
  bool holds(std::size_t model) const { return holds_[model]; }
  /// The oscillation on a line or ellipse that applies and is fitted to the longest window.
  std::optional<std::size_t> longest_swing() const;
  /// Position of the centre `s` seconds after the newest sighting.
  Vec2 position(std::size_t model, const MotionTrail& trail, double s) const;
  /// Rotation of the body [rad] by then since the newest sighting.
  double turn(std::size_t model, const MotionTrail& trail, double s) const;

 private:
  void fit_swings(std::span<const Sighting> seen, double noise, OscillationFit& fit);
  void fit_arcs(std::span<const Sighting> seen, double noise, OscillationFit& fit);

  /// Maximum distance of an oscillation from sightings with this noise [µm].
  double tolerance(double noise) const { return tuning_.max_offset + tuning_.noise_gain * noise; }

  MotionModelsTuning tuning_;
  RecurrenceTuning recurrence_;
  TrackedBody motion_;
  double turn_rate_ = 0;  ///< [rad/s]
  bool turns_ = false;    ///< whether it has turned recently
  std::array<bool, count> holds_{};
  std::array<Oscillation, windows> swings_;
  std::array<ArcSwing, windows> arcs_;
  Recurrence again_;
  std::vector<Sighting> along_;  ///< arc lengths on the circle
};

}  // namespace microswarm::navigation
