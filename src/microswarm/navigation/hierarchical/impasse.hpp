// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace microswarm::navigation {

/// Decides when a navigator that comes no nearer to its goal lets another one lead, and until when:
/// from `patience` after it was nearest, until the way left is shorter by `distance`, which doubles
/// from time to time, and nothing is near.
class Impasse {
 public:
  /// `patience` [s], infinite for never; `distance` [µm].
  Impasse(double patience, double distance) : patience_(patience), distance_(distance) {}

  /// Whether the other leads at the time `now` [s], `left` [µm] before the goal.
  bool update(double now, double left, bool is_alone) {
    if (led_to_ && (left > *led_to_ || !is_alone)) return true;
    if (led_to_ || !since_ || left < nearest_ - min_progress) {
      led_to_.reset();
      nearest_ = left;
      since_ = now;
    }
    if (now - *since_ < patience_) return false;
    led_to_ = nearest_ - distance_;
    distance_ *= 2;
    return true;
  }

 private:
  static constexpr double min_progress = 1;  // [µm]

  double patience_;
  double distance_;
  double nearest_ = 0;            ///< least way left [µm]
  std::optional<double> since_;   ///< time at which it was reached [s]
  std::optional<double> led_to_;  ///< way left at which the other ends [µm]
};

}  // namespace microswarm::navigation
