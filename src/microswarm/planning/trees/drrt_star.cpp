// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/drrt_star.hpp"
#include "microswarm/planning/common/free_goal.hpp"

#include <algorithm>
#include <limits>

#include "microswarm/core/fields/published.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/planning/common/detection.hpp"
#include "microswarm/planning/exact/exact.hpp"
#include "microswarm/planning/trees/straighten.hpp"
#include "microswarm/planning/trees/tree_growth.hpp"
#include "microswarm/planning/trees/turn_edge.hpp"

namespace microswarm::planning {
namespace {

constexpr int max_time_steps = 10'000;

/// Shorter arcs are always steered, since they might end where they begin.
constexpr double min_open_length = 1e-3;  // [µm]

/// X_new and the node it was steered from, as Algorithm 3 returns them.
struct Extension {
  std::uint32_t nearest;
  Vec2 end;
};

/// Candidate of Algorithm 3. Where the arc is free wherever it goes, it is steered only if the
/// candidate is chosen.
struct Candidate {
  std::uint32_t nearest = 0;
  double heading = 0;
  double length = 0;
  std::optional<Vec2> end;
};

/// Unicycle under heading control: the points of the swept arc, starting with the node's position,
/// for `length` µm in equal steps of at most dt. Eq 6, 7 [drrt].
void steer_arc(const TreeNode& node, double heading_wanted, double length,
               const DrrtStarParams& params, std::vector<Vec2>& arc) {
  const double duration = length / params.speed;  // T_d
  const double count =
      std::clamp(std::ceil(duration / params.time_step), 1.0, 1.0 * max_time_steps);
  const double dt = duration / count;
  const double gain = std::min(1.0, dt * params.heading_gain);  // no step overshoots
  Vec2 p = node.position;
  double heading = node.heading;
  arc.assign(1, p);
  for (int j = 0; j < static_cast<int>(count); ++j) {
    heading += gain * wrap(heading_wanted - heading);  // Eq 7 [drrt]
    p += dt * params.speed * unit_vector(heading);     // Eq 6 [drrt]
    arc.push_back(p);
  }
}

/// Chain of turning edges through points of a path, as chords, and its cost.
struct TurnedPath {
  std::vector<Vec2> chords;
  double cost = 0;
};

/// Connects the points edge by edge; with `shortcuts` each edge goes to the farthest point that it
/// reaches without collision. Empty if a point is not reached.
TurnedPath chain(const Snapshot& world, Pose2 start, std::span<const Vec2> points, PathCost cost,
                 double clearance, bool shortcuts, std::uint64_t& checks) {
  const double radius = cost.turn_radius;
  TurnedPath out{.chords = {start.position}};
  TreeNode at{.position = start.position, .heading = start.heading};
  std::vector<Vec2> chords;
  for (std::size_t i = 0; i + 1 < points.size();) {
    std::size_t next = shortcuts ? points.size() - 1 : i + 1;
    for (; next > i; --next) {
      if (points[next] == at.position) continue;
      chords.clear();
      append_edge({at.position, at.heading}, points[next], radius, chords);
      ++checks;
      if (!shortcuts || world.is_free(chords, clearance + chord_error(radius))) break;
    }
    if (next == i) return {};
    out.cost += cost.edge(at, points[next]);
    at.heading = cost.heading_at_end(at, points[next]);
    at.position = points[next];
    out.chords.insert(out.chords.end(), chords.begin() + 1, chords.end());
    i = next;
  }
  return out;
}

/// The tree's path with turning edges, or a cheaper one through some of its points.
std::vector<Vec2> turned_path(const Snapshot& world, Pose2 start, std::span<const Vec2> points,
                              PathCost cost, const DrrtStarParams& params, std::uint64_t& checks) {
  TurnedPath path = chain(world, start, points, cost, params.clearance, false, checks);
  if (!params.straighten) return path.chords;
  TurnedPath shorter = chain(world, start, points, cost, params.clearance, true, checks);
  return !shorter.chords.empty() && shorter.cost < path.cost ? shorter.chords : path.chords;
}

/// Ends the path where it comes within `tolerance` [µm] of the goal, without a wall between.
void end_within(const Map& map, double tolerance, Vec2 goal, std::vector<Vec2>& path) {
  constexpr double rounding = 1e-9;
  const GoalArea area(map, goal, (1 + rounding) * tolerance);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double share = first_contact({path[i - 1], path[i]}, tolerance, Disc{goal, 0});
    if (share > 1) continue;
    const Vec2 end = path[i - 1] + share * (path[i] - path[i - 1]);
    if (!area.contains(end)) continue;
    path[i] = end;
    path.resize(i + 1);
    return;
  }
}

/// Whether the edges keep the clearance, and all bodies that are no walls are clear of the
/// detection circles along them.
bool is_undisturbed(const Snapshot& world, std::span<const Vec2> path,
                    const DrrtStarParams& params) {
  const double near = params.clearance + 0.5 * params.detection_diameter;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Segment edge{path[i - 1], path[i]};
    if (!world.is_free(edge, params.clearance) || !world.moving().is_free(edge, near)) return false;
  }
  return true;
}

/// The shortest path, cut at the goal tolerance, or why there is none. Beyond the paper.
Plan find_route(const Snapshot& world, Pose2 start, Vec2 goal, const DrrtStarParams& params,
                Rng& rng, const Stop& stop) {
  // The exact planner keeps a clearance to a relative 1e-7, and a point at the tolerance is
  // rounded.
  constexpr double rounding = 2e-7;
  const auto search = [&](double clearance) {
    return plan(world, start, goal, ExactParams{clearance, params.goal_tolerance}, rng, stop);
  };
  Plan route = search((1 + rounding) * params.clearance);
  if (route.status != Status::solved) route = search(params.clearance);
  if (route.status == Status::solved)
    end_within(world.map(), (1 - rounding) * params.goal_tolerance, goal, route.path);
  return route;
}

class DrrtStar {
 public:
  DrrtStar(const Snapshot& world, Pose2 start, Vec2 goal, const DrrtStarParams& params, Rng& rng,
           const Stop& stop)
      : world_(world),
        start_(start),
        params_(params),
        stop_(stop),
        arcs_(params_.arcs),
        cost_{params.length_weight, params.smoothness_weight, arcs_ ? params.turn_radius : 0},
        growth_(world, start, goal, params, cost_, rng, stop) {}

  /// Algorithm 2 [drrt].
  Plan run() {
    detections_.push_back(detect_at(position(0)));
    while (growth_.goes_on()) {                                                   // line 2
      const std::optional<Extension> x_new = sample_by_cost();                    // line 3
      if (!x_new || !growth_.edge_is_free(x_new->nearest, x_new->end)) continue;  // line 4
      growth_.find_near(x_new->end, params_);                                     // line 5
      const auto parent = growth_.choose_parent(x_new->end, x_new->nearest);      // line 6, Eq 9
      const Vec2 centre = 0.5 * (position(x_new->nearest) + x_new->end);
      const std::uint32_t node = growth_.add(parent, x_new->end);  // line 7
      detections_.push_back(detect_at(centre));
      growth_.rewire(node);  // line 8, Eq 10
    }
    return finish();  // lines 9–12
  }

 private:
  Vec2 position(std::uint32_t node) const { return growth_.tree()[node].position; }
  Detection detect_at(Vec2 centre) const {
    return detect(world_, {centre, 0.5 * params_.detection_diameter}, params_.rho_min, stop_);
  }

  /// Algorithm 3 [drrt].
  std::optional<Extension> sample_by_cost() {
    std::optional<Candidate> best;
    double best_cost = std::numeric_limits<double>::infinity();
    int found = 0;
    for (int i = 0; i < params_.max_attempts && found < params_.candidates; ++i) {  // line 2
      const std::optional<Vec2> x_rand = growth_.sample();                          // line 3
      if (!x_rand) continue;
      const std::uint32_t nearest = growth_.tree().nearest(*x_rand);  // line 4
      const TreeNode& node = growth_.tree()[nearest];
      if (*x_rand == node.position || !growth_.is_free(Segment{node.position, *x_rand}))
        continue;                                                                 // line 7
      Candidate x_steer{nearest, heading_along(*x_rand - node.position), 0, {}};  // Eq 5 [drrt]
      if (!steer(node, *x_rand, x_steer)) continue;                               // lines 10–11
      ++found;                                                                    // line 14
      const double cost =
          params_.smoothness_weight * turn_between(x_steer.heading, node.heading);  // Eq 8
      if (cost < best_cost) {                                                       // lines 16–17
        best_cost = cost;
        best = x_steer;
      }
    }
    if (!best) return std::nullopt;
    return Extension{best->nearest, best->end ? *best->end : end_of_arc(*best)};
  }

  /// Steers towards the sample; false if the arc is not free.
  bool steer(const TreeNode& node, Vec2 sample, Candidate& to) {
    const double step = detections_[to.nearest].rho * params_.step;
    if (arcs_) {
      steer_turn(node, sample, step);
    } else {
      to.length = std::min(step, distance(node.position, sample));
      if (to.length > min_open_length && growth_.is_open(node.position, to.length)) return true;
      steer_arc(node, to.heading, to.length, params_, arc_);
    }
    to.end = arc_.back();
    return !(arc_.back() == node.position) && growth_.is_free(arc_);
  }

  Vec2 end_of_arc(const Candidate& to) {
    steer_arc(growth_.tree()[to.nearest], to.heading, to.length, params_, arc_);
    return arc_.back();
  }

  /// First `step` µm of the edge to the sample.
  void steer_turn(const TreeNode& node, Vec2 sample, double step) {
    const Pose2 from{node.position, node.heading};
    const TurnEdge edge = turn_edge(from, sample, params_.turn_radius);
    arc_.clear();
    append_chords(from, edge, params_.turn_radius, std::min(step, edge.length), arc_);
  }

  Plan finish() {
    Plan plan = growth_.finish();
    plan.detections = std::move(detections_);
    if (arcs_) {
      plan.path = turned_path(world_, start_, plan.path, cost_, params_, plan.counts.edge_checks);
    } else if (params_.straighten) {
      straighten(world_, params_.clearance, start_.heading, cost_, straighten_rounds, plan.path,
                 plan.counts.edge_checks);
    }
    return plan;
  }

  const Snapshot& world_;
  Pose2 start_;
  DrrtStarParams params_;
  const Stop& stop_;
  bool arcs_;
  PathCost cost_;
  TreeGrowth growth_;
  std::vector<Detection> detections_;  ///< per node: its ρ scales the steps from it
  std::vector<Vec2> arc_;
};

}  // namespace

DrrtStarParams DrrtStarParams::in_effect() const {
  DrrtStarParams p = *this;
  if (!as_published) return p;
  p.straighten = false;
  p.exact_route = false;
  p.arcs = false;
  return p;
}

Issues validate(const DrrtStarParams& params, const IsGiven& is_given) {
  if (!params.as_published) return {};
  return validate_published(is_given, params, params.in_effect(), DrrtStarParams{});
}

namespace {

Plan grow(const Snapshot& world, Pose2 start, Vec2 goal, const DrrtStarParams& params, Rng& rng,
          const Stop& stop) {
  return DrrtStar(world, start, goal, params, rng, stop).run();
}

/// Grows the tree, and takes the shortest path instead where that costs less.
Plan grow_beside_route(const Snapshot& world, Pose2 start, Vec2 goal, DrrtStarParams params,
                       Rng& rng, const Stop& stop) {
  Plan route = find_route(world, start, goal, params, rng, stop);
  const bool is_usable =
      route.status == Status::solved && is_undisturbed(world, route.path, params);
  // A tree that need not find the way, or cannot, is not grown to limits that suit a large map.
  const DrrtStarParams usual;
  const int iterations = route.status == Status::no_path ? 1 : usual.max_iterations;
  if (is_usable || route.status == Status::no_path) {
    params.max_nodes = std::min(params.max_nodes, usual.max_nodes);
    params.max_iterations = std::min(params.max_iterations, iterations);
  }
  Plan made = grow(world, start, goal, params, rng, stop);
  made.counts.edge_checks += route.counts.edge_checks;
  if (route.status == Status::no_path && made.status == Status::node_limit) {
    made.status = Status::no_path;
    made.path = std::move(route.path);
  }
  if (!is_usable) return made;
  const PathCost cost{params.length_weight, params.smoothness_weight};
  straighten(world, params.clearance, start.heading, cost, 0, route.path, made.counts.edge_checks);
  if (made.status == Status::solved &&
      cost.of(made.path, start.heading) <= cost.of(route.path, start.heading))
    return made;
  made.status = Status::solved;
  made.path = std::move(route.path);
  return made;
}

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const DrrtStarParams& params, Rng& rng,
          const Stop& stop) {
  const DrrtStarParams used = params.in_effect();
  return used.exact_route && !used.arcs ? grow_beside_route(world, start, goal, used, rng, stop)
                                        : grow(world, start, goal, used, rng, stop);
}

}  // namespace microswarm::planning
