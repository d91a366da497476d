// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/farthest_pair.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace microswarm::navigation {
namespace {

using Distances = std::vector<std::uint32_t>;

/// The node, by its place, with the greatest distance among those reached.
std::size_t farthest(const Distances& distances, std::span<const std::uint32_t> nodes) {
  std::size_t best = 0;
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t far = distances[nodes[i]];
    if (far == CellGraph::unreached || far <= most) continue;
    most = far;
    best = i;
  }
  return best;
}

/// Node half way on a shortest path from `node` to where the distances begin.
std::uint32_t midpoint(const CellGraph& graph, const Distances& distances, std::uint32_t node) {
  const std::uint32_t half = distances[node] / 2;
  while (distances[node] > half) node = graph.towards(distances, node);
  return node;
}

}  // namespace

NodePair farthest_pair(const CellGraph& graph, std::span<const std::uint32_t> nodes) {
  const std::size_t end = farthest(graph.distances(nodes[0]), nodes);
  NodePair best{end, end, 0};
  const auto try_from = [&](std::size_t i) {
    Distances distances = graph.distances(nodes[i]);
    const std::size_t other = farthest(distances, nodes);
    const std::uint32_t far = distances[nodes[other]];
    if (far != CellGraph::unreached && far > best.distance) best = {i, other, far};
    return distances;
  };
  const Distances from_end = try_from(end);
  if (best.distance == 0) return best;
  const Distances from_middle = graph.distances(midpoint(graph, from_end, nodes[best.second]));
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto far = [&](std::size_t i) { return from_middle[nodes[i]]; };
  std::erase_if(order, [&](std::size_t i) { return far(i) == CellGraph::unreached; });
  std::ranges::stable_sort(order, std::ranges::greater{}, far);
  for (const std::size_t i : order) {
    if (2 * far(i) <= best.distance) break;
    // Nothing is farther from here than by way of the middle.
    if (i != end && far(i) + far(order.front()) > best.distance) try_from(i);
  }
  return best;
}

}  // namespace microswarm::navigation
