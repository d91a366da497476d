// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "microswarm/actuation/coils/coil_controller.hpp"

namespace microswarm::rig {

/// Load of the coils relative to their limits.
struct CoilLoad {
  double current = 0;  ///< peak of the last second, in the coil nearest to its limit [A]
  std::optional<double> max_current{};      ///< its limit, if any [A]
  double temperature = 0;                   ///< of the coil nearest to its limit [°C]
  std::optional<double> max_temperature{};  ///< its limit, if any [°C]
  double scale = 1;                ///< minimum of the last second: scale by the coils' limits
  actuation::CoilOutput output{};  ///< the newest output; without currents before the first
};

/// Maximum over the last 0.5 to 1 s.
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
  /// The maximum, in the unit of the values.
  double value() const { return std::max(peaks_[0], peaks_[1]); }

 private:
  double since_ = 0;
  std::array<double, 2> peaks_{};
};

/// Updates a CoilLoad from the outputs to the coils.
class CoilLoadMeter {
 public:
  /// `system` must outlive the meter.
  explicit CoilLoadMeter(const actuation::CoilSystem& system) : system_(system) {}

  /// Takes an output at `t` [s].
  void take(double t, const actuation::CoilOutput& output);
  /// Load at the last output.
  const CoilLoad& load() const { return load_; }

 private:
  const actuation::CoilSystem& system_;
  RecentPeak share_, current_, weakening_;
  CoilLoad load_;
};

}  // namespace microswarm::rig
