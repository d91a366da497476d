// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/cell_graph.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/infinity.hpp"

namespace microswarm::navigation {
namespace {

constexpr double max_cells = 100'000;  // the lattice allows 40 times as many

}  // namespace

std::size_t CellGraph::nearest_direction(Vec2 offset) {
  const int x = (offset.x > 0) - (offset.x < 0);
  const int y = (offset.y > 0) - (offset.y < 0);
  constexpr std::array<std::array<std::size_t, 3>, 3> by_row{{{5, 6, 7}, {4, 0, 0}, {3, 2, 1}}};
  return by_row[static_cast<std::size_t>(y + 1)][static_cast<std::size_t>(x + 1)];
}

CellGraph::CellGraph(const Map& map, double cell, CellSteps steps)
    : steps_(steps), lattice_(map.bounds(), cell, max_cells), cell_(lattice_.spacing()) {
  at_.assign(lattice_.size(), unreached);
  for (std::uint32_t place = 0; place < lattice_.size(); ++place) {
    if (!map.is_free(lattice_[place], 0)) continue;
    at_[place] = size();
    centres_.push_back(lattice_[place]);
  }
  if (centres_.empty()) throw InputError("no cell of the map is free");
  for (std::uint32_t place = 0; place < lattice_.size(); ++place) {
    const std::uint32_t node = at_[place];
    if (node == unreached) continue;
    neighbours_.emplace_back().fill(node);
    lattice_.for_each_neighbour(place, [&](std::uint32_t other) {
      if (at_[other] == unreached) return;
      const Segment edge{centres_[node], lattice_[other]};
      if (steps_ == CellSteps::hops || map.is_free(edge, 0))
        neighbours_[node][nearest_direction(edge.b - edge.a)] = at_[other];
    });
  }
}

std::uint32_t CellGraph::nearest(const Map& map, Vec2 p) const {
  std::uint32_t best = unreached;
  double least = infinity;
  for (const bool visible : {true, false}) {
    if (best != unreached) break;
    lattice_.for_each_around(p, [&](std::uint32_t place) {
      const double far = squared_norm(lattice_[place] - p);
      if (at_[place] == unreached || far >= least) return;
      if (visible && !map.is_free(Segment{p, lattice_[place]}, 0)) return;
      least = far;
      best = at_[place];
    });
  }
  if (best != unreached) return best;
  const auto far = [&](Vec2 centre) { return squared_norm(centre - p); };
  return static_cast<std::uint32_t>(std::ranges::min_element(centres_, {}, far) - centres_.begin());
}

// Dijkstra with a ring of buckets, one per unit: no step is longer than 7 units.
std::vector<std::uint32_t> CellGraph::distances(std::uint32_t from, std::uint32_t until) const {
  std::vector<std::uint32_t> found(size(), unreached);
  std::array<std::vector<std::uint32_t>, 8> buckets;
  found[from] = 0;
  buckets[0].push_back(from);
  std::size_t open = 1;
  for (std::uint32_t at = 0; open > 0; ++at) {
    std::vector<std::uint32_t>& bucket = buckets[at % buckets.size()];
    for (const std::uint32_t node : bucket) {
      if (found[node] != at) continue;
      if (node == until) return found;
      for (std::size_t k = 0; k < directions; ++k) {
        const std::uint32_t next = neighbours_[node][k];
        const std::uint32_t length = at + cost(k);
        if (length >= found[next]) continue;
        found[next] = length;
        buckets[length % buckets.size()].push_back(next);
        ++open;
      }
    }
    open -= bucket.size();
    bucket.clear();
  }
  return found;
}

std::uint32_t CellGraph::towards(const std::vector<std::uint32_t>& distances,
                                 std::uint32_t node) const {
  if (distances[node] == unreached) return node;
  for (std::size_t k = 0; k < directions; ++k) {
    const std::uint32_t next = neighbours_[node][k];
    if (next != node && distances[next] != unreached &&
        distances[next] + cost(k) == distances[node])
      return next;
  }
  return node;
}

}  // namespace microswarm::navigation
