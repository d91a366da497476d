// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical/predicted_target.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::navigation {
namespace {

constexpr double same_place = 1;  // [µm]
constexpr double piece_time = 1;  // of a way that is searched for its first contact [s]

/// Time for which the straight path of this heading stays free of obstacles [s], at most `most` and
/// its duration.
double free_time(const Snapshot& frame, const ObstaclePredictor& obstacles, Segment leg,
                 double heading, double speed, double start, double most, double clearance) {
  const double time = std::min(most, distance(leg.a, leg.b) / speed);
  const Vec2 velocity = speed * unit_vector(heading);
  for (double t = 0; t < time; t += piece_time) {
    const double end = std::min(time, t + piece_time);
    const Segment piece{leg.a + t * velocity, leg.a + end * velocity};
    if (obstacles.clearance(frame, piece, start + t, start + end, clearance + 1) < clearance)
      return t;
  }
  return time;
}

class PredictedChoice {
 public:
  PredictedChoice(const Snapshot& frame, const ObstaclePredictor& obstacles,
                  const PredictedTargetQuery& query, const std::function<double(Vec2)>& length_from)
      : frame_(frame), obstacles_(obstacles), q_(query), length_from_(length_from) {}

  /// Takes the target, reached after a wait [s], if no other has cost less.
  void consider(Vec2 target, double wait) {
    const Vec2 from = q_.swarm.position;
    const double length = distance(from, target);
    const double heading = heading_along(target - from);
    double cost = length + q_.wait_weight * q_.speed * wait +
                  q_.turn_weight * turn_between(heading, q_.swarm.heading);
    if (!(cost < best_cost_) || !frame_.map().is_free(Segment{from, target}, q_.clearance)) return;
    cost += length_from_(target);
    if (!(cost < best_cost_)) return;
    const double time = length / q_.speed;
    if (!rests_freely(wait) || free_time({from, target}, heading, wait, time) < time) return;
    const Vec2 next = distance(target, q_.towards) > same_place ? q_.towards : q_.goal;
    const double left = std::min(q_.horizon - wait - time, distance(target, next) / q_.speed);
    if (left > 0) {
      const double next_heading = heading_along(next - target);
      cost += q_.turn_weight * turn_between(next_heading, heading);
      if (cost >= best_cost_) return;  // a contact only adds to it
      cost += q_.contact_weight * q_.speed *
              (left - free_time({target, next}, next_heading, wait + time, left));
    }
    if (cost >= best_cost_) return;
    best_cost_ = cost;
    best_ = PredictedTarget{target, wait};
  }
  const std::optional<PredictedTarget>& best() const { return best_; }

 private:
  double free_time(Segment leg, double heading, double start, double most) const {
    return microswarm::navigation::free_time(frame_, obstacles_, leg, heading, q_.speed,
                                             q_.delay + start, most, q_.clearance);
  }
  bool rests_freely(double wait) const {
    const Segment here{q_.swarm.position, q_.swarm.position};
    for (double t = 0; t < wait; t += piece_time)
      if (obstacles_.clearance(frame_, here, q_.delay + t, q_.delay + t + piece_time,
                               q_.clearance + 1) < q_.clearance)
        return false;
    return true;
  }

  const Snapshot& frame_;
  const ObstaclePredictor& obstacles_;
  const PredictedTargetQuery& q_;
  const std::function<double(Vec2)>& length_from_;
  std::optional<PredictedTarget> best_;
  double best_cost_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<PredictedTarget> select_predicted_target(
    const Snapshot& frame, const ObstaclePredictor& obstacles, const PredictedTargetQuery& q,
    const std::function<double(Vec2)>& length_from) {
  const Vec2 from = q.swarm.position;
  const double straight = heading_along(q.towards - from);
  const double goal_distance = distance(from, q.goal);
  const int directions = std::max(4, static_cast<int>(std::lround(2 * pi / q.angle_step)));
  PredictedChoice choice(frame, obstacles, q, length_from);
  for (const double wait : q.wait_times) {
    if (wait > 0 && wait > q.max_wait) break;
    if (goal_distance <= q.reach) choice.consider(q.goal, wait);
    for (double reach = std::min(q.reach, goal_distance); reach >= q.min_reach; reach /= 2)
      for (int k = 0; k < directions; ++k)
        choice.consider(from + reach * unit_vector(straight + 2 * pi * k / directions), wait);
  }
  return choice.best();
}

bool is_free_in_time(const Snapshot& frame, const ObstaclePredictor& obstacles,
                     std::span<const Vec2> path, double speed, double delay, double horizon,
                     double clearance) {
  double t = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Segment leg{path[i], path[i + 1]};
    if (!frame.map().is_free(leg, clearance)) return false;
    const double time = std::min(horizon - t, distance(leg.a, leg.b) / speed);
    if (time <= 0) continue;
    if (free_time(frame, obstacles, leg, heading_along(leg.b - leg.a), speed, delay + t, time,
                  clearance) < time)
      return false;
    t += time;
  }
  return true;
}

}  // namespace microswarm::navigation
