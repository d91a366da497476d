// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/drrt_star.hpp"

#include <algorithm>
#include <limits>

#include "microswarm/core/angles.hpp"
#include "microswarm/planning/detection.hpp"
#include "microswarm/planning/straighten.hpp"
#include "microswarm/planning/tree_growth.hpp"

namespace microswarm {
namespace {

constexpr int most_time_steps = 10'000;

/// X_new and the node it was steered from, as Algorithm 3 returns them.
struct Extension {
  std::uint32_t nearest;
  Vec2 end;
};

/// The unicycle under heading control: the points of the swept arc, the node's position first. It
/// goes on for `length` µm in equal steps of at most dt. Eq 6, 7 [drrt].
void steer_arc(const TreeNode& node, double heading_wanted, double length,
               const DrrtStarParams& params, std::vector<Vec2>& arc) {
  const double duration = length / params.speed;  // T_d
  const double count =
      std::clamp(std::ceil(duration / params.time_step), 1.0, 1.0 * most_time_steps);
  const double dt = duration / count;
  const double gain = std::min(1.0, dt * params.heading_gain);  // no step turns past what is wanted
  Vec2 p = node.position;
  double heading = node.heading;
  arc.assign(1, p);
  for (int j = 0; j < static_cast<int>(count); ++j) {
    heading += gain * wrap(heading_wanted - heading);  // Eq 7 [drrt]
    p += dt * params.speed * unit_vector(heading);     // Eq 6 [drrt]
    arc.push_back(p);
  }
}

class DrrtStar {
 public:
  DrrtStar(const Snapshot& world, Pose2 start, Vec2 goal, const DrrtStarParams& params, Rng& rng,
           const Stop& stop)
      : world_(world),
        start_(start),
        params_(params),
        cost_{params.length_weight, params.smoothness_weight},
        growth_(world, start, goal, params, cost_, rng, stop) {}

  /// Algorithm 2 [drrt].
  Plan run() {
    detections_.push_back(detect_at(position(0)));
    while (growth_.goes_on()) {                                               // line 2
      const std::optional<Extension> x_new = sample_by_cost();                // line 3
      if (!x_new || !growth_.is_free(edge_to(*x_new))) continue;              // line 4
      growth_.find_near(x_new->end, params_);                                 // line 5
      const auto parent = growth_.choose_parent(x_new->end, x_new->nearest);  // line 6, Eq 9
      const Vec2 centre = 0.5 * (position(x_new->nearest) + x_new->end);
      const std::uint32_t node = growth_.add(parent, x_new->end);  // line 7
      detections_.push_back(detect_at(centre));
      growth_.rewire(node);  // line 8, Eq 10
    }
    return finish();  // lines 9–12
  }

 private:
  Vec2 position(std::uint32_t node) const { return growth_.tree()[node].position; }
  Segment edge_to(const Extension& x) const { return {position(x.nearest), x.end}; }
  Detection detect_at(Vec2 centre) const {
    return detect(world_, {centre, 0.5 * params_.detection_diameter}, params_.rho_min);
  }

  /// Algorithm 3 [drrt].
  std::optional<Extension> sample_by_cost() {
    std::optional<Extension> best;
    double best_cost = std::numeric_limits<double>::infinity();
    int found = 0;
    for (int i = 0; i < params_.max_attempts && found < params_.candidates; ++i) {  // line 2
      const std::optional<Vec2> x_rand = growth_.sample();                          // line 3
      if (!x_rand) continue;
      const std::uint32_t nearest = growth_.tree().nearest(*x_rand);  // line 4
      const TreeNode& node = growth_.tree()[nearest];
      if (*x_rand == node.position || !growth_.is_free(Segment{node.position, *x_rand}))
        continue;                                                  // 7
      const double heading = heading_of(*x_rand - node.position);  // Eq 5 [drrt]
      const double step = detections_[nearest].rho * params_.step;
      steer_arc(node, heading, std::min(step, distance(node.position, *x_rand)), params_, arc_);
      if (arc_.back() == node.position || !growth_.is_free(arc_)) continue;  // line 11
      ++found;                                                               // line 14
      const double cost = params_.smoothness_weight * turn_between(heading, node.heading);  // Eq 8
      if (cost < best_cost) {  // lines 16–17
        best_cost = cost;
        best = Extension{nearest, arc_.back()};
      }
    }
    return best;
  }

  Plan finish() {
    Plan plan = growth_.finish();
    plan.detections = std::move(detections_);
    if (params_.straighten) {
      straighten(world_, params_.clearance, start_.heading, cost_, straighten_rounds, plan.path,
                 plan.counts.edge_checks);
    }
    return plan;
  }

  const Snapshot& world_;
  Pose2 start_;
  const DrrtStarParams& params_;
  PathCost cost_;
  TreeGrowth growth_;
  std::vector<Detection> detections_;  ///< of each node: its ρ scales the steps from it
  std::vector<Vec2> arc_;
};

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const DrrtStarParams& params, Rng& rng,
          const Stop& stop) {
  return DrrtStar(world, start, goal, params, rng, stop).run();
}

}  // namespace microswarm
