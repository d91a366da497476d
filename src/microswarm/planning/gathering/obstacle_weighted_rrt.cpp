// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/gathering/obstacle_weighted_rrt.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "microswarm/core/maths/heap_entry.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/planning/gathering/tree_cover.hpp"

namespace microswarm::planning {
namespace {

/// Wall contacts are located to 2^-20 of an extension.
constexpr int halvings = 20;

using Tree = ObstacleWeightedRrt;

using Entry = HeapEntry<double>;

Vec2 contact(const Map& map, Segment s) {
  double free = 0;
  double blocked = 1;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (free + blocked);
    (map.is_free(Segment{s.a, s.a + middle * (s.b - s.a)}, 0) ? free : blocked) = middle;
  }
  return s.a + free * (s.b - s.a);
}

/// Alg 1 [gather]. Extensions have full length, also beyond the sample.
Status grow(const Map& map, const ObstacleWeightedRrtParams& params, Rng& rng, const Stop& stop,
            PointGrid& grid, Tree& tree) {
  const Box& bounds = map.bounds();
  Routes& plain = tree.plain;
  for (int i = 0; tree.nodes.size() < static_cast<std::size_t>(params.nodes); ++i) {
    if (i == params.max_iterations) return Status::node_limit;
    if (i % 256 == 0) {
      if (const auto reason = stop.status()) return *reason;
    }
    const Vec2 sample = uniform_in(bounds, rng);
    const bool thins_out = params.wall_samples < 1 && !map.is_free(sample, 0);
    if (thins_out && rng.uniform() >= params.wall_samples) continue;
    const std::uint32_t near = grid.nearest(sample);
    const Vec2 from = tree.nodes[near];
    const double far = distance(from, sample);
    if (far == 0) continue;
    const Vec2 p = from + (params.extension / far) * (sample - from);
    if (!map.is_free(Segment{from, p}, 0)) {
      tree.boundary.push_back(contact(map, {from, p}));
      continue;
    }
    grid.add(p);
    tree.nodes.push_back(p);
    plain.next.push_back(near);
    plain.cost.push_back(plain.cost[near] + distance(from, p));
  }
  return Status::solved;
}

/// Beyond the paper: adds nodes that the tree has missed. Their clearance comes from the map
/// instead of V_obs.
void complete(const Map& map, const ObstacleWeightedRrtParams& params, PointGrid& grid,
              Tree& tree) {
  const double radius = std::max(params.neighbour_radius, 2 * params.extension);
  cover(map, grid, params.extension, radius, [&](Vec2 p, std::uint32_t parent) {
    tree.plain.next.push_back(parent);
    tree.plain.cost.push_back(tree.plain.cost[parent] + distance(p, tree.nodes[parent]));
    grid.add(p);
    tree.nodes.push_back(p);
  });
}

/// Eq 3 [gather], shifted down to reach 0 at the cutoff. The goal's weight is 0, since every route
/// ends there.
void weigh(const Map& map, const ObstacleWeightedRrtParams& params, Tree& tree) {
  PointGrid boundary(map.bounds());
  for (const Vec2 p : tree.boundary) boundary.add(p);
  const double at_cutoff =
      maths::exp(params.weight_exponent - params.weight_decay * params.weight_cutoff);
  for (std::size_t v = 0; v < tree.nodes.size(); ++v) {
    const Vec2 p = tree.nodes[v];
    const bool grown = v < tree.grown && !boundary.empty();
    const double d = grown ? distance(p, boundary[boundary.nearest(p)]) : map.clearance(p);
    const double w = maths::exp(params.weight_exponent - params.weight_decay * d) - at_cutoff;
    tree.clearances.push_back(d);
    tree.weights.push_back(d < params.weight_cutoff ? std::max(w, 0.0) : 0);
  }
  tree.weights[0] = 0;
}

/// Node that may be joined to another; lightest first.
struct Link {
  double weight;
  std::uint32_t node;
  std::uint32_t from;
  auto operator<=>(const Link&) const = default;
};

/// Alg 2 [gather]: V* and the routes over it.
class Router {
 public:
  Router(const Map& map, const ObstacleWeightedRrtParams& params, const PointGrid& grid, Tree& tree)
      : map_(map),
        grid_(grid),
        radius_(std::max(params.neighbour_radius, params.extension * (1 + 1e-9))),
        attach_radius_(params.attach_radius),
        tree_(tree) {
    tree_.medial.assign(tree_.nodes.size(), 0);
    routes().next.assign(tree_.nodes.size(), 0);
    routes().cost.assign(tree_.nodes.size(), infinity);
    routes().length.assign(tree_.nodes.size(), infinity);
  }

  /// Eq 4 [gather].
  void choose_medial(double zeta) {
    for (std::uint32_t v = 0; v < tree_.nodes.size(); ++v) {
      tree_.medial[v] = v == 0 || tree_.weights[v] < zeta;
    }
  }

  /// Beyond the paper: adds the middle of channels too narrow for Eq 4, from which V* is not
  /// visible.
  void add_narrow(double share) {
    if (share <= 0) return;
    const auto [medial, nodes] = middle();
    std::vector<std::uint32_t> unserved;
    for (std::uint32_t v = 0; v < tree_.nodes.size(); ++v) {
      if (!tree_.medial[v] && nearest_seen(medial, tree_.nodes[v]) == no_node) {
        unserved.push_back(v);
      }
    }
    for (const std::uint32_t v : unserved) tree_.medial[v] = is_middle(v, share);
  }

  /// Joins the components of V* through the lightest nodes, by Prim's algorithm over all nodes,
  /// which minimises the heaviest node needed. Only the nodes needed are added to V*.
  void join_medial(double zeta) {
    tree_.zeta_used = zeta;
    std::vector<std::uint32_t> parent(tree_.nodes.size(), no_node);
    std::vector<std::uint8_t> joined(tree_.nodes.size(), 0);
    std::size_t wanted = 0;
    for (const std::uint8_t m : tree_.medial) wanted += m;
    std::priority_queue<Link, std::vector<Link>, std::greater<>> open;
    open.push({0, 0, 0});
    while (!open.empty() && wanted > 0) {
      const Link top = open.top();
      open.pop();
      if (parent[top.node] != no_node || !sees(top.from, top.node)) continue;
      parent[top.node] = top.from;
      if (tree_.medial[top.node]) {
        --wanted;
        for (std::uint32_t v = top.node; !joined[v]; v = parent[v]) {
          joined[v] = 1;
          if (!tree_.medial[v]) admit(v);
        }
      }
      for_neighbours(top.node, [&](std::uint32_t v) {
        if (parent[v] == no_node) open.push({tree_.medial[v] ? 0 : tree_.weights[v], v, top.node});
      });
    }
  }

  /// Lines 7–12: shortest routes over V*.
  void route_medial() {
    routes().cost[0] = routes().length[0] = 0;
    dijkstra({{0, 0}}, [&](std::uint32_t v) { return tree_.medial[v] != 0; });
  }

  /// Lines 13–16: the other nodes go to the nearest visible node of V*.
  void connect_rest() {
    const auto [medial, nodes] = middle();
    for (std::uint32_t v = 0; v < tree_.nodes.size(); ++v) {
      if (tree_.medial[v]) continue;
      const std::uint32_t found = nearest_seen(medial, tree_.nodes[v]);
      if (found != no_node) set_next(v, nodes[found]);
    }
  }

  /// Beyond the paper: a node from which V* is not visible goes through nodes that see it.
  void route_rest() {
    std::vector<Entry> reached;
    for (std::uint32_t v = 0; v < tree_.nodes.size(); ++v) {
      if (routes().cost[v] < infinity) reached.push_back({routes().cost[v], v});
    }
    if (reached.size() == tree_.nodes.size()) return;
    std::vector<std::uint8_t> waits(tree_.nodes.size(), 1);
    for (const Entry& e : reached) waits[e.node] = 0;
    dijkstra(reached, [&](std::uint32_t v) { return waits[v] != 0; });
  }

 private:
  Routes& routes() { return tree_.weighted; }
  bool sees(std::uint32_t u, std::uint32_t v) const {
    return map_.is_free(Segment{tree_.nodes[u], tree_.nodes[v]}, 0);
  }
  double edge(std::uint32_t v, std::uint32_t to) const {
    return distance(tree_.nodes[v], tree_.nodes[to]) + tree_.weights[to];
  }
  void set_next(std::uint32_t v, std::uint32_t to) {
    routes().next[v] = to;
    routes().cost[v] = edge(v, to) + routes().cost[to];
    routes().length[v] = distance(tree_.nodes[v], tree_.nodes[to]) + routes().length[to];
  }

  void admit(std::uint32_t node) {
    tree_.medial[node] = 1;
    tree_.zeta_used =
        std::max(tree_.zeta_used, std::nextafter(tree_.weights[node], infinity));  // w < ζ
  }

  /// Whether the node has at least this share of the maximum clearance around it; ζ corresponds to
  /// 0.7 in the published channels.
  bool is_middle(std::uint32_t node, double share) {
    near_.clear();
    grid_.within(tree_.nodes[node], std::max(tree_.clearances[node], radius_), near_);
    return std::all_of(near_.begin(), near_.end(), [&](std::uint32_t v) {
      return tree_.clearances[node] >= share * tree_.clearances[v];
    });
  }

  /// V* as a grid, and its nodes in the grid's order.
  std::pair<PointGrid, std::vector<std::uint32_t>> middle() const {
    std::pair<PointGrid, std::vector<std::uint32_t>> out{PointGrid(map_.bounds()), {}};
    for (std::uint32_t v = 0; v < tree_.nodes.size(); ++v) {
      if (!tree_.medial[v]) continue;
      out.first.add(tree_.nodes[v]);
      out.second.push_back(v);
    }
    return out;
  }

  /// Dijkstra from the reached nodes into those that `admits` allows.
  template <class Admits>
  void dijkstra(const std::vector<Entry>& from, Admits&& admits) {
    std::priority_queue<Entry> open(std::less<Entry>{}, from);
    while (!open.empty()) {
      const Entry top = open.top();
      open.pop();
      if (top.cost > routes().cost[top.node]) continue;
      for_neighbours(top.node, [&](std::uint32_t v) {
        if (!admits(v) || edge(v, top.node) + top.cost >= routes().cost[v]) return;
        if (!sees(v, top.node)) return;
        set_next(v, top.node);
        open.push({routes().cost[v], v});
      });
    }
  }

  template <class Visit>
  void for_neighbours(std::uint32_t node, Visit&& visit) {
    near_.clear();
    grid_.within(tree_.nodes[node], radius_, near_);
    for (const std::uint32_t v : near_) {
      if (v != node) visit(v);
    }
  }

  std::uint32_t nearest_seen(const PointGrid& points, Vec2 p) {
    for (double radius = radius_ / 2;; radius = std::min(2 * radius, attach_radius_)) {
      near_.clear();
      points.within(p, radius, near_);
      std::uint32_t best = no_node;
      double least = infinity;
      for (const std::uint32_t v : near_) {
        const double d = distance(p, points[v]);
        if (d < least && map_.is_free(Segment{p, points[v]}, 0)) {
          least = d;
          best = v;
        }
      }
      if (best != no_node || radius >= attach_radius_) return best;
    }
  }

  const Map& map_;
  const PointGrid& grid_;
  double radius_;
  double attach_radius_;
  Tree& tree_;
  std::vector<std::uint32_t> near_;
};

/// Alg 2 [gather]; the reason if interrupted.
std::optional<Status> route(const Map& map, const ObstacleWeightedRrtParams& params,
                            const PointGrid& grid, const Stop& stop, Tree& tree) {
  Router router(map, params, grid, tree);
  router.choose_medial(params.zeta);
  router.add_narrow(params.narrow_share);
  if (const auto reason = stop.status()) return reason;
  router.join_medial(params.zeta);
  if (const auto reason = stop.status()) return reason;
  router.route_medial();
  if (const auto reason = stop.status()) return reason;
  router.connect_rest();
  if (const auto reason = stop.status()) return reason;
  router.route_rest();
  return std::nullopt;
}

}  // namespace

ObstacleWeightedRrtParams scaled(ObstacleWeightedRrtParams params, double factor) {
  params.extension *= factor;
  params.weight_decay /= factor;
  params.weight_exponent += maths::log(factor);
  params.weight_cutoff *= factor;
  params.zeta *= factor;
  params.neighbour_radius *= factor;
  params.attach_radius *= factor;
  return params;
}

ObstacleWeightedRrt obstacle_weighted_rrt(const Map& map, Vec2 goal,
                                          const ObstacleWeightedRrtParams& params, Rng& rng,
                                          const Stop& stop) {
  Tree tree;
  tree.zeta_used = params.zeta;
  if (!is_finite(goal) || !map.is_free(goal, 0)) {
    tree.status = Status::goal_blocked;
    return tree;
  }
  PointGrid grid(map.bounds());
  grid.add(goal);
  tree.nodes.push_back(goal);
  tree.plain = {{0}, {0}, {}};
  tree.status = grow(map, params, rng, stop, grid, tree);
  tree.grown = tree.nodes.size();
  if (params.complete && tree.status == Status::solved) complete(map, params, grid, tree);
  tree.plain.length = tree.plain.cost;
  weigh(map, params, tree);
  tree.lookup = NodeLookup(map, grid, stop);
  if (tree.status == Status::solved || tree.status == Status::node_limit) {
    if (const auto reason = route(map, params, grid, stop, tree)) tree.status = *reason;
  }
  const bool was_stopped = tree.status == Status::stopped || tree.status == Status::time_limit;
  if (was_stopped) tree.weighted = tree.plain;
  return tree;
}

}  // namespace microswarm::planning
