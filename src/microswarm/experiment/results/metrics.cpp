// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/results/metrics.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/statistics.hpp"

namespace microswarm::experiment {

double avoidance_cost(Vec2 towards, double left, double heading, bool moves,
                      double start_distance) {
  const double ahead = norm(towards);
  if (ahead == 0 || start_distance <= 0) return 0;
  const double cosine = moves ? dot(unit_vector(heading), towards) / ahead : 0;
  return left * (1 - cosine) / start_distance;
}

TimeSummary summarise(std::span<const double> seconds) {
  if (seconds.empty()) return {};
  std::vector<double> sorted(seconds.begin(), seconds.end());
  std::sort(sorted.begin(), sorted.end());
  const double n = static_cast<double>(sorted.size());
  double sum = 0, squares = 0;
  for (double s : sorted) sum += s;
  for (double s : sorted) squares += (s - sum / n) * (s - sum / n);
  return {.count = static_cast<int>(sorted.size()),
          .mean = sum / n,
          .sd = sorted.size() > 1 ? std::sqrt(squares / (n - 1)) : 0,
          .p50 = quantile(sorted, 0.5),
          .p99 = quantile(sorted, 0.99),
          .max = sorted.back()};
}

}  // namespace microswarm::experiment
