// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/gathering/map_segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace microswarm::planning {
namespace {

constexpr std::uint32_t unassigned = ~0u;
/// Inner radius of the ring in which the channels around a node are counted, relative to its range.
constexpr double ring_begin = 0.6;
/// Minimum number of nodes in a channel.
constexpr std::size_t min_in_channel = 3;
/// Minimum fraction of a region's nodes in a branch.
constexpr double min_in_branch = 0.05;

/// Sums for the covariance ellipse of points.
class Spread {
 public:
  void add(Vec2 p) {
    count_ += 1;
    sum_ += p;
    xx_ += p.x * p.x;
    yy_ += p.y * p.y;
    xy_ += p.x * p.y;
  }
  /// 0 for a circle, 1 for a line.
  double eccentricity() const {
    if (count_ < 3) return 1;
    const Vec2 mean = sum_ / count_;
    const double xx = xx_ / count_ - mean.x * mean.x;
    const double yy = yy_ / count_ - mean.y * mean.y;
    const double xy = xy_ / count_ - mean.x * mean.y;
    const double middle = 0.5 * (xx + yy);
    const double half = norm({0.5 * (xx - yy), xy});
    if (!(middle + half > 0)) return 1;
    return std::sqrt(std::clamp(1 - (middle - half) / (middle + half), 0.0, 1.0));
  }

 private:
  double count_ = 0;
  Vec2 sum_;
  double xx_ = 0;
  double yy_ = 0;
  double xy_ = 0;
};

/// Splits directions where neighbours are more than `gap` apart. Returns the mean direction of each
/// group of at least `least` directions; without a gap all form one group.
std::vector<double> bundles(std::vector<double>& angles, double gap, std::size_t least) {
  std::vector<double> means;
  if (angles.empty()) return means;
  std::sort(angles.begin(), angles.end());
  const std::size_t n = angles.size();
  auto opens = [&](std::size_t i) {
    const double before = i == 0 ? angles[n - 1] - 2 * pi : angles[i - 1];
    return angles[i] - before > gap;
  };
  std::size_t first = 0;
  while (first < n && !opens(first)) ++first;
  first %= n;
  Vec2 sum;
  std::size_t size = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (first + k) % n;
    sum += unit_vector(angles[i]);
    ++size;
    if (k + 1 < n && !opens((i + 1) % n)) continue;
    if (size >= least) means.push_back(heading_along(sum));
    sum = {};
    size = 0;
  }
  return means;
}

/// Merges the two nearest directions until at most `most` remain.
void merge_nearest(std::vector<double>& directions, int most) {
  while (directions.size() > static_cast<std::size_t>(std::max(1, most))) {
    std::size_t a = 0;
    std::size_t b = 1;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      for (std::size_t k = i + 1; k < directions.size(); ++k) {
        if (turn_between(directions[i], directions[k]) <
            turn_between(directions[a], directions[b])) {
          a = i;
          b = k;
        }
      }
    }
    directions[a] = heading_along(unit_vector(directions[a]) + unit_vector(directions[b]));
    directions.erase(directions.begin() + static_cast<std::ptrdiff_t>(b));
  }
}

std::uint32_t nearest_direction(const std::vector<double>& directions, double angle) {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < directions.size(); ++i) {
    if (turn_between(directions[i], angle) < turn_between(directions[best], angle)) best = i;
  }
  return best;
}

class Segmenter {
 public:
  Segmenter(const Map& map, const ObstacleWeightedRrt& tree, const Routes& routes,
            const MapSegmentationParams& params)
      : map_(map), tree_(tree), routes_(routes), params_(params), grid_(map.bounds()) {
    for (std::uint32_t v = 0; v < tree_.nodes.size(); ++v) {
      if (!tree_.medial[v]) continue;
      medial_.push_back(v);
      grid_.add(tree_.nodes[v]);
    }
    by_cost_.resize(tree_.nodes.size());
    std::iota(by_cost_.begin(), by_cost_.end(), 0u);
    std::sort(by_cost_.begin(), by_cost_.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double cost_a = routes_.cost[a];
      const double cost_b = routes_.cost[b];
      return cost_a != cost_b ? cost_a < cost_b : a < b;
    });
    cluster_.assign(tree_.nodes.size(), unassigned);
    out_.region.assign(tree_.nodes.size(), 0);
    out_.branch.assign(tree_.nodes.size(), 0);
  }

  MapSegmentation segment(const Stop& stop) {
    find_junction_nodes(stop);               // lines 1–4
    if (!stop()) cluster_by_distance(stop);  // line 5
    if (stop()) return {};
    grow_regions();   // line 6
    find_branches();  // lines 7–10
    return std::move(out_);
  }

 private:
  Vec2 at(std::uint32_t node) const { return tree_.nodes[node]; }
  bool sees(Vec2 a, Vec2 b) const { return map_.is_free(Segment{a, b}, 0); }

  /// Width of the channel around a node: twice the maximum clearance of its neighbours.
  double width(std::uint32_t node) {
    double widest = tree_.clearances[node];
    near_.clear();
    grid_.within(at(node), widest, near_);
    for (const std::uint32_t i : near_) widest = std::max(widest, tree_.clearances[medial_[i]]);
    return 2 * widest;
  }

  /// Def 4; beyond it, enough channels must lead away.
  bool is_junction(std::uint32_t node, double range) {
    Spread spread;
    angles_.clear();
    near_.clear();
    grid_.within(at(node), range, near_);
    for (const std::uint32_t i : near_) {
      const Vec2 p = grid_[i];
      if (!sees(at(node), p)) continue;
      spread.add(p - at(node));
      if (distance(at(node), p) >= ring_begin * range)
        angles_.push_back(heading_along(p - at(node)));
    }
    if (spread.eccentricity() >= params_.eccentricity) return false;
    return static_cast<int>(bundles(angles_, params_.arm_gap, min_in_channel).size()) >=
           params_.arms;
  }

  void find_junction_nodes(const Stop& stop) {
    out_.junction_nodes.push_back(0);
    widths_.push_back(width(0));
    for (const std::uint32_t v : medial_) {
      if (v == 0) continue;
      if (stop()) return;
      const double w = width(v);
      if (!is_junction(v, params_.range * w)) continue;
      out_.junction_nodes.push_back(v);
      widths_.push_back(w);
    }
  }

  /// Single linkage: nodes that are near and visible form one junction. The goal's cluster is the
  /// first.
  void cluster_by_distance(const Stop& stop) {
    const std::vector<std::uint32_t>& junctions = out_.junction_nodes;
    PointGrid grid(map_.bounds());
    for (const std::uint32_t v : junctions) grid.add(at(v));
    std::vector<std::uint8_t> seen(junctions.size(), 0);
    std::vector<std::uint32_t> members;
    for (std::uint32_t first = 0; first < junctions.size(); ++first) {
      if (seen[first]) continue;
      seen[first] = 1;
      members.assign(1, first);
      for (std::size_t done = 0; done < members.size(); ++done) {
        if (stop()) return;
        const std::uint32_t i = members[done];
        near_.clear();
        grid.within(grid[i], params_.merge_distance * widths_[i], near_);
        for (const std::uint32_t k : near_) {
          if (seen[k] || !sees(grid[i], grid[k])) continue;
          seen[k] = 1;
          members.push_back(k);
        }
      }
      if (first > 0 && !fills_its_place(members)) continue;
      for (const std::uint32_t i : members) cluster_[junctions[i]] = clusters_;
      ++clusters_;
    }
    std::erase_if(out_.junction_nodes, [&](std::uint32_t v) { return cluster_[v] == unassigned; });
  }

  /// Rejects a few nodes in the corner of a bend: within half a channel width of the centre, enough
  /// nodes must be junction nodes.
  bool fills_its_place(const std::vector<std::uint32_t>& members) {
    Vec2 centroid;
    double widest = 0;
    for (const std::uint32_t i : members) {
      centroid += at(out_.junction_nodes[i]);
      widest = std::max(widest, widths_[i]);
    }
    centroid = centroid / static_cast<double>(members.size());
    near_.clear();
    grid_.within(centroid, widest / 4, near_);
    const auto inside = std::count_if(members.begin(), members.end(), [&](std::uint32_t i) {
      return distance(at(out_.junction_nodes[i]), centroid) <= widest / 4;
    });
    return static_cast<double>(inside) > params_.fill * static_cast<double>(near_.size());
  }

  /// A region consists of its junction and all nodes whose route to the goal reaches this junction
  /// first. If the route of a junction's node passes a region farther away, the node belongs to
  /// that region, so that no route ever enters a region with a higher number.
  void grow_regions() {
    std::vector<std::uint32_t> number(clusters_, unassigned);
    for (const std::uint32_t v : by_cost_) {
      const std::uint32_t onward = out_.region[routes_.next[v]];
      out_.region[v] = onward;
      if (cluster_[v] == unassigned) continue;
      std::uint32_t& n = number[cluster_[v]];
      if (n == unassigned) {
        n = static_cast<std::uint32_t>(out_.regions.size());
        out_.regions.push_back({{}, v, v, onward, 0});
      }
      if (onward <= n) {
        out_.region[v] = n;
      } else {
        cluster_[v] = unassigned;
      }
    }
    std::erase_if(out_.junction_nodes, [&](std::uint32_t v) { return cluster_[v] == unassigned; });
    place_junctions();
  }

  void place_junctions() {
    std::vector<double> counts(out_.regions.size(), 0);
    for (const std::uint32_t v : out_.junction_nodes) {
      out_.regions[out_.region[v]].junction += at(v);
      counts[out_.region[v]] += 1;
    }
    for (std::size_t r = 0; r < counts.size(); ++r) {
      out_.regions[r].junction = out_.regions[r].junction / counts[r];
    }
    out_.regions[0].junction = at(0);
    for (const std::uint32_t v : out_.junction_nodes) {
      Region& region = out_.regions[out_.region[v]];
      if (distance(at(v), region.junction) < distance(at(region.node), region.junction)) {
        region.node = v;
      }
    }
    out_.regions[0].node = 0;
  }

  /// Direction of a node from its region's junction.
  double direction(std::uint32_t v) const {
    return heading_along(at(v) - out_.regions[out_.region[v]].junction);
  }

  /// Branches are distinguished by the direction in which the route to a node leaves the junction;
  /// a channel that bends later remains one branch.
  void find_branches() {
    std::vector<std::vector<double>> leaving(out_.regions.size());
    std::vector<std::uint32_t> first(tree_.nodes.size(), unassigned);
    for (const std::uint32_t v : by_cost_) {
      if (cluster_[v] != unassigned) continue;
      const std::uint32_t next = routes_.next[v];
      first[v] = cluster_[next] != unassigned ? v : first[next];
      if (tree_.medial[v]) leaving[out_.region[v]].push_back(direction(first[v]));
    }
    std::vector<std::vector<double>> branches;
    for (std::size_t r = 0; r < leaving.size(); ++r) {
      const double least = min_in_branch * static_cast<double>(leaving[r].size());
      branches.push_back(bundles(leaving[r], params_.arm_gap, static_cast<std::size_t>(least)));
      if (branches[r].empty()) branches[r].push_back(0);
      merge_nearest(branches[r], params_.max_branches);
      out_.regions[r].branches = static_cast<std::uint32_t>(branches[r].size());
    }
    for (const std::uint32_t v : by_cost_) {
      const std::uint32_t from = first[v] == unassigned ? v : first[v];
      out_.branch[v] = tree_.medial[v]
                           ? nearest_direction(branches[out_.region[v]], direction(from))
                           : out_.branch[routes_.next[v]];
    }
  }

  const Map& map_;
  const ObstacleWeightedRrt& tree_;
  const Routes& routes_;
  const MapSegmentationParams& params_;
  PointGrid grid_;                     ///< V*
  std::vector<std::uint32_t> medial_;  ///< its nodes
  std::vector<std::uint32_t> by_cost_;
  std::vector<std::uint32_t> cluster_;  ///< per node; unassigned outside V_J
  std::uint32_t clusters_ = 0;
  std::vector<double> widths_;  ///< one per junction node
  std::vector<std::uint32_t> near_;
  std::vector<double> angles_;
  MapSegmentation out_;
};

}  // namespace

MapSegmentation segment_map(const Map& map, const ObstacleWeightedRrt& tree, const Routes& routes,
                            const MapSegmentationParams& params, const Stop& stop) {
  return Segmenter(map, tree, routes, params).segment(stop);
}

}  // namespace microswarm::planning
