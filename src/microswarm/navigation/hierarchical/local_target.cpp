// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical/local_target.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::navigation {
namespace {

struct Candidate {
  double cost;
  double heading;
};

double nearness(double clearance, double range) {
  const double far = 1 - std::min(clearance, range) / range;
  return far * far;
}

// Eq 4 [drrt]
double selection_cost(const Snapshot& world, const LocalTargetQuery& q, const LocalTargetParams& p,
                      double range, Vec2 test, double heading) {
  const double goal_turn = turn_between(heading, q.goal_heading) / (2 * pi);
  double cost = p.obstacle_weight * nearness(world.obstacle_clearance(test), range) +    // Eq 4c
                p.border_weight * nearness(world.map().border_clearance(test), range) +  // Eq 4d
                p.goal_weight * goal_turn * goal_turn;                                   // Eq 4e
  if (q.previous_target) {                                                               // Eq 4f
    const double previous = heading_along(*q.previous_target - q.swarm.position);
    const double turn = turn_between(heading, previous) / (2 * pi);
    cost += p.direction_weight * turn * turn;
  }
  return cost;
}

std::optional<double> best_heading(const Snapshot& world, const LocalTargetQuery& q,
                                   const LocalTargetParams& p, double range, double distance,
                                   double half_angle) {
  const Vec2 from = q.swarm.position;
  std::vector<Candidate> candidates;
  const int side = static_cast<int>(std::floor(half_angle / p.angle_step + 1e-9));
  for (int k = -side; k <= side; ++k) {  // lines 6–10
    const double heading = q.swarm.heading + k * p.angle_step;
    const Vec2 test = from + distance * unit_vector(heading);
    if (!world.bounds().contains(test)) continue;
    candidates.push_back({selection_cost(world, q, p, range, test, heading), heading});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  for (const Candidate& c : candidates)  // lines 12–18
    if (world.is_free(Segment{from, from + distance * unit_vector(c.heading)}, q.clearance))
      return c.heading;
  return std::nullopt;
}

// The circle lies midway to the previous target; for the first one its diameter is ‖s_s − s_g‖.
Detection detect_obstacles(const Snapshot& world, const LocalTargetQuery& query,
                           const LocalTargetParams& params, const Stop& stop) {
  const Vec2 from = query.swarm.position;
  const double ahead = query.previous_target
                           ? std::min(params.base_distance, distance(from, *query.previous_target))
                           : query.goal_distance;
  const double towards =
      query.previous_target ? heading_along(*query.previous_target - from) : query.goal_heading;
  const double diameter = query.previous_target ? params.detection_diameter : query.goal_distance;
  return planning::detect(world, {from + 0.5 * ahead * unit_vector(towards), 0.5 * diameter},
                          params.rho_min, stop);
}

}  // namespace

double target_distance(const Snapshot& world, const LocalTargetQuery& query,
                       const LocalTargetParams& params, const Stop& stop) {
  return detect_obstacles(world, query, params, stop).rho * params.base_distance;
}

std::optional<LocalTarget> select_local_target(const Snapshot& world, const LocalTargetQuery& query,
                                               const LocalTargetParams& params, const Stop& stop) {
  const Vec2 from = query.swarm.position;
  if (!world.is_free(from, query.clearance)) return std::nullopt;
  const double r = std::max(1.0, query.clearance);
  const double range = params.influence_range.value_or(r * r);
  const Detection detection = detect_obstacles(world, query, params, stop);

  double reach = std::min(detection.rho * params.base_distance, query.goal_distance);
  const double least = std::min(reach, std::max(query.min_distance, 1e-3));
  for (; reach >= least; reach /= 2)
    for (const double half_angle : {params.half_angle, pi}) {
      if (stop()) return std::nullopt;
      if (const auto heading = best_heading(world, query, params, range, reach, half_angle))
        return LocalTarget{from + reach * unit_vector(*heading), detection};
    }
  return std::nullopt;
}

}  // namespace microswarm::navigation
