// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm {

/// Histogram of durations in fixed memory: bins of 1 % from 1 µs to about 1000 s.
class Durations {
 public:
  /// Adds a duration [s].
  void add(double seconds) {
    const double step = maths::log(std::max(seconds, shortest) / shortest) / growth;
    ++counts_[std::min(static_cast<std::size_t>(step), counts_.size() - 1)];
    longest_ = std::max(longest_, seconds);
    ++count_;
  }
  double longest() const { return longest_; }  ///< [s]; 0 if empty
  std::size_t count() const { return static_cast<std::size_t>(count_); }
  /// Quantile q in [0, 1] by nearest rank [s], rounded up by at most 1 % or 1 µs; 0 if empty.
  double quantile(double q) const {
    const auto rank = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_)));
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      below += counts_[i];
      if (below >= std::max<std::uint64_t>(rank, 1))
        return std::min(longest_, shortest * maths::exp(growth * static_cast<double>(i + 1)));
    }
    return 0;
  }

 private:
  static constexpr double shortest = 1e-6;               // [s]
  static constexpr double growth = 0.00995033085316808;  // ln 1.01

  std::array<std::uint32_t, 2083> counts_{};
  std::uint64_t count_ = 0;
  double longest_ = 0;  // [s]
};

}  // namespace microswarm
