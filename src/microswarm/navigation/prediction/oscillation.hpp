// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/navigation/prediction/motion_fit.hpp"

namespace microswarm {

/// A place that swings: value + rate · sin(ωt) / ω + curve · (1 − cos ωt) / ω², t [s] counted from
/// the newest sighting. Lines, ellipses and circles at their own pace are of this form; for ω → 0
/// it is a constant acceleration.
struct Oscillation {
  double frequency = 0;  ///< ω [rad/s]
  Vec2 value;            ///< [µm]
  Vec2 rate;             ///< [µm/s]
  Vec2 curve;            ///< [µm/s²]

  Vec2 at(double t) const;
};

/// Fits oscillations to sightings by least squares, over windows of three lengths. The frequency is
/// the best of a fixed ladder, refined between its rungs by a parabola. The sines of a frame's time
/// are worked out once for all bodies that were seen in it. Allocates nothing after it is made.
class OscillationFit {
 public:
  static constexpr std::array<double, 3> windows{1.2, 3, 8};  ///< [s]
  using Fits = std::array<std::optional<Oscillation>, windows.size()>;

  OscillationFit();

  /// Begins a frame taken at `now` [s], later than the one before; no sighting may be newer.
  void begin(double now);
  /// The best oscillation through the sightings of each window, the newest of them taken in the
  /// present frame; none where they are too few or the window holds no more than the one before.
  Fits fit(std::span<const Sighting> sightings);

 private:
  static constexpr std::size_t rungs = 48;
  static constexpr std::size_t max_rows = 104;
  struct Row {
    double t = 0;
    std::array<double, rungs> sine;    ///< sin(ωt) / ω
    std::array<double, rungs> cosine;  ///< (1 − cos ωt) / ω²
  };
  struct Sums;

  void fill(Row& row) const;
  std::optional<Oscillation> best_of(const Sums& sums, Vec2 origin) const;

  std::array<double, rungs> frequencies_{};
  double now_ = 0;
  std::vector<Row> rows_;  ///< ascending in time
};

}  // namespace microswarm
