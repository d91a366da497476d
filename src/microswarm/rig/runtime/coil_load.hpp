// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "microswarm/actuation/coils/coil_controller.hpp"

namespace microswarm {

/// How near the coils are to their limits.
struct CoilLoad {
  double current = 0;                     ///< peak of the last second, of the most loaded coil [A]
  std::optional<double> max_current;      ///< its limit, if any [A]
  double temperature = 0;                 ///< of the hottest coil, for its limit [°C]
  std::optional<double> max_temperature;  ///< its limit, if any [°C]
  double scale = 1;                       ///< least scale of the last second by the coils' limits
  CoilOutput output;                      ///< the newest; without currents before the first
};

/// Largest value of the last second, or of a little less.
class RecentPeak {
 public:
  void add(double t, double value) {
    constexpr double half = 0.5;  // [s]
    if (t >= since_ + half) {
      peaks_ = {t < since_ + 2 * half ? peaks_[1] : 0, 0};
      since_ = t;
    }
    peaks_[1] = std::max(peaks_[1], value);
  }
  double value() const { return std::max(peaks_[0], peaks_[1]); }

 private:
  double since_ = 0;
  std::array<double, 2> peaks_{};
};

/// Follows what goes to the coils.
class CoilLoadMeter {
 public:
  /// `system` must outlive it.
  explicit CoilLoadMeter(const CoilSystem& system) : system_(system) {}

  /// Takes an output at `t` [s].
  void take(double t, const CoilOutput& output);
  /// At the last output.
  const CoilLoad& load() const { return load_; }

 private:
  const CoilSystem& system_;
  RecentPeak share_, current_, weakening_;
  CoilLoad load_;
};

}  // namespace microswarm
