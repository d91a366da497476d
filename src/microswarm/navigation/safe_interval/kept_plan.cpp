// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/safe_interval/kept_plan.hpp"

#include <algorithm>

namespace microswarm::navigation {

void KeptPlan::adopt(std::span<const planning::TimedPoint> path, double begin, double left) {
  legs_.clear();
  next_ = 0;
  left_ = left;
  if (path.empty()) return;
  from_ = path.front().position;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = distance(path[i - 1].position, path[i].position);
    if (length == 0) continue;
    legs_.push_back({path[i].position, begin + path[i].arrival - length / speed_});
  }
}

void KeptPlan::advance(Vec2 position, double reach) {
  while (!empty()) {
    const Vec2 end = leg().end;
    const bool passed = !is_last() && dot(end - from_, position - end) >= 0;
    if (distance(position, end) > reach && !passed) return;
    skip();
  }
}

double KeptPlan::duration(Vec2 position, double now) const {
  double t = now;
  for (const Leg& leg : legs()) {
    t = std::max(t, leg.depart) + distance(position, leg.end) / speed_;
    position = leg.end;
  }
  return t - now;
}

double KeptPlan::conflict(Vec2 position, double now, const ObstacleForecast& forecast, int samples,
                          double radius, double share, double recovery) const {
  const auto left = legs();
  std::size_t k = 0;
  double t = 0;
  for (int sample = 0; sample < samples; ++sample) {
    const double until = (sample + 1) * forecast.step();
    Vec2 there = position;
    while (k < left.size()) {
      t = std::max(t, left[k].depart - now);
      if (t >= until) break;
      const double away = distance(there, left[k].end);
      const double needed = away / speed_;
      if (t + needed > until) {
        there += (until - t) * speed_ / away * (left[k].end - there);
        t = until;
        break;
      }
      there = left[k++].end;
      t += needed;
    }
    t = std::max(t, until);
    for (std::size_t i = 0; i < forecast.size(); ++i) {
      const double wanted = share * forecast.gap(sample + 1, i);
      const double grown = forecast.present_gap(i) + recovery * sample * forecast.step();
      const double needed = std::min(wanted, grown);
      if (forecast.gap_along({position, there}, sample, i, radius, wanted) < needed)
        return sample * forecast.step();
    }
    if (k == left.size()) return infinity;
    position = there;
  }
  return infinity;
}

}  // namespace microswarm::navigation
