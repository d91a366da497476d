// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/metrics.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm {

TimeSummary summarise(std::span<const double> seconds) {
  if (seconds.empty()) return {};
  std::vector<double> sorted(seconds.begin(), seconds.end());
  std::sort(sorted.begin(), sorted.end());
  const double n = static_cast<double>(sorted.size());
  double sum = 0, squares = 0;
  for (double s : sorted) sum += s;
  for (double s : sorted) squares += (s - sum / n) * (s - sum / n);
  const auto percentile = [&](double p) {
    return sorted[static_cast<std::size_t>(std::max(1.0, std::ceil(p * n))) - 1];
  };
  return {.count = static_cast<int>(sorted.size()),
          .mean = sum / n,
          .sd = sorted.size() > 1 ? std::sqrt(squares / (n - 1)) : 0,
          .p50 = percentile(0.5),
          .p99 = percentile(0.99),
          .max = sorted.back()};
}

}  // namespace microswarm
