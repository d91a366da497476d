// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/safe_interval/kept_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::navigation {

void KeptPlan::adopt(std::span<const planning::TimedPoint> path, double begin, double left) {
  legs_.clear();
  next_ = 0;
  left_ = left;
  if (path.empty()) return;
  from_ = path.front().position;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = distance(path[i - 1].position, path[i].position);
    const bool is_stay = length == 0 && path[i].arrival > path[i - 1].arrival;
    if (length == 0 && !is_stay) continue;
    legs_.push_back({path[i].position, begin + path[i].arrival - length / speed_});
  }
}

void KeptPlan::advance(Vec2 position, double reach, double now) {
  while (!empty()) {
    if (is_stay() && leg().depart > now) return;
    const Vec2 end = leg().end;
    const bool passed = !is_last() && dot(end - from_, position - end) >= 0;
    if (distance(position, end) > reach && !passed) return;
    skip();
  }
}

/// Time for which the swarm turns from `course` [rad], which becomes the leg's, before it leaves
/// `from` [s].
double KeptPlan::turn_delay(const Leg& leg, Vec2 from, double& course) const {
  const Vec2 way = leg.end - from;
  if (std::isinf(turning_.turn_rate) || squared_norm(way) == 0) return 0;
  const double before = std::exchange(course, heading_along(way));
  return turning_.delay(turn_between(course, before));
}

double KeptPlan::duration(const Pose2& pose, double now) const {
  Vec2 position = pose.position;
  double course = pose.heading;
  double t = now;
  for (const Leg& leg : legs()) {
    t += turn_delay(leg, position, course);
    t = std::max(t, leg.depart) + distance(position, leg.end) / speed_;
    position = leg.end;
  }
  return t - now;
}

double KeptPlan::conflict(const Pose2& pose, double now, const ObstacleForecast& forecast,
                          int samples, double radius, double share, double recovery) const {
  const auto left = legs();
  Vec2 position = pose.position;
  double course = pose.heading;
  std::size_t k = 0;
  double t = left.empty() ? 0 : turn_delay(left[0], position, course);
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
      if (k < left.size()) t += turn_delay(left[k], there, course);
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
