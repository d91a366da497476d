// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/gathering/tree_cover.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "microswarm/world/map/lattice.hpp"

namespace microswarm::planning {
namespace {

class Cover {
 public:
  using Add = std::function<void(Vec2, std::uint32_t)>;

  Cover(const Map& map, const PointGrid& nodes, double cell, double radius, const Add& add)
      : map_(map),
        nodes_(nodes),
        lattice_(map.bounds(), cell, 100'000),
        radius_(std::max(radius, 2 * lattice_.spacing())),
        add_(add),
        seen_(lattice_.size(), no_node),
        own_(lattice_.size(), no_node) {}

  void run() {
    std::vector<std::uint32_t> queue;
    lattice_.for_each_around(nodes_[0], [&](std::uint32_t cell) {
      if (!map_.is_free(Segment{nodes_[0], lattice_[cell]}, 0)) return;
      seen_[cell] = 0;
      queue.push_back(cell);
    });
    for (std::size_t k = 0; k < queue.size(); ++k) {
      const std::uint32_t before = queue[k];
      lattice_.for_each_neighbour(before, [&](std::uint32_t cell) {
        if (seen_[cell] != no_node) return;
        if (!map_.is_free(Segment{lattice_[before], lattice_[cell]}, 0)) return;
        seen_[cell] = nearest_seen(lattice_[cell]);
        if (seen_[cell] == no_node) seen_[cell] = node_in(before);
        queue.push_back(cell);
      });
    }
  }

 private:
  std::uint32_t nearest_seen(Vec2 p) {
    near_.clear();
    nodes_.within(p, radius_, near_);
    std::uint32_t best = no_node;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : near_) {
      const double d = distance(p, nodes_[v]);
      if (d >= least || !map_.is_free(Segment{p, nodes_[v]}, 0)) continue;
      least = d;
      best = v;
    }
    return best;
  }

  /// Node at the cell's centre, added if necessary.
  std::uint32_t node_in(std::uint32_t cell) {
    if (own_[cell] == no_node) {
      own_[cell] = static_cast<std::uint32_t>(nodes_.size());
      add_(lattice_[cell], seen_[cell]);
    }
    return own_[cell];
  }

  const Map& map_;
  const PointGrid& nodes_;
  NodeLattice lattice_;
  double radius_;
  const Add& add_;
  std::vector<std::uint32_t> seen_;  ///< node visible from the cell's centre
  std::vector<std::uint32_t> own_;   ///< node at the cell's centre
  std::vector<std::uint32_t> near_;
};

}  // namespace

void cover(const Map& map, const PointGrid& nodes, double cell, double radius,
           const std::function<void(Vec2 p, std::uint32_t parent)>& add) {
  Cover(map, nodes, cell, radius, add).run();
}

}  // namespace microswarm::planning
