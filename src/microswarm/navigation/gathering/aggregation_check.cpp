// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/aggregation_check.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "microswarm/world/map/lattice.hpp"

namespace microswarm::navigation {
namespace {

/// Nodes of a lattice that are reached from a point over steps that are free and `admitted`.
template <class Admitted>
std::vector<bool> flood(const Map& map, const NodeLattice& lattice, Vec2 from,
                        Admitted&& admitted) {
  std::vector<bool> reached(lattice.size(), false);
  std::vector<std::uint32_t> open;
  const auto visit = [&](Vec2 p, std::uint32_t node) {
    if (reached[node] || !admitted(node) || !map.is_free(Segment{p, lattice[node]}, 0)) return;
    reached[node] = true;
    open.push_back(node);
  };
  lattice.for_each_around(from, [&](std::uint32_t node) { visit(from, node); });
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    lattice.for_each_neighbour(node, [&](std::uint32_t next) { visit(lattice[node], next); });
  }
  return reached;
}

double reached_share(const Map& map, Vec2 goal) {
  const NodeLattice lattice(map.bounds(), 0, 1'000'000);
  const std::vector<bool> reached = flood(map, lattice, goal, [](std::uint32_t) { return true; });
  double free = 0;
  double counted = 0;
  for (std::uint32_t node = 0; node < lattice.size(); ++node) {
    if (!map.is_free(lattice[node], 0)) continue;
    ++free;
    counted += reached[node];
  }
  return free > 0 ? counted / free : 0;
}

/// Pieces of the ring between one width and 1.25 that are reached without leaving it outwards.
int exits(const Map& map, Vec2 goal, double width) {
  const double outer = 1.25 * width;
  const Vec2 half{outer, outer};
  const NodeLattice lattice({goal - half, goal + half}, width / 24, 4000);
  const auto far = [&](std::uint32_t node) { return distance(lattice[node], goal); };
  const std::vector<bool> near =
      flood(map, lattice, goal, [&](std::uint32_t node) { return far(node) <= outer; });
  std::vector<bool> counted(lattice.size(), false);
  int exits = 0;
  for (std::uint32_t node = 0; node < lattice.size(); ++node) {
    if (!near[node] || counted[node] || far(node) < width) continue;
    ++exits;
    const std::vector<bool> piece = flood(map, lattice, lattice[node], [&](std::uint32_t other) {
      return near[other] && far(other) >= width;
    });
    for (std::uint32_t other = 0; other < lattice.size(); ++other)
      if (piece[other]) counted[other] = true;
    counted[node] = true;
  }
  return exits;
}

}  // namespace

MapAssumptions map_assumptions(const Map& map, Vec2 goal, double width) {
  return {reached_share(map, goal), exits(map, goal, width)};
}

std::vector<std::string> unmet_assumptions(const Map& map, Vec2 goal, double width) {
  const MapAssumptions ground = map_assumptions(map, goal, width);
  std::vector<std::string> unmet;
  if (ground.reached_share < 0.999)
    unmet.push_back(fmt::format("the map is not connected: the goal is reached from {:.1f} % of it",
                                100 * ground.reached_share));
  if (ground.exits != 1)
    unmet.push_back(fmt::format(
        "the goal is at no dead end: {} channels lead away from it, so robots may be pushed out",
        ground.exits));
  return unmet;
}

std::string too_few_regions(std::size_t regions) {
  constexpr std::size_t enough = 5;
  if (regions >= enough) return {};
  return fmt::format(
      "the map has {} regions: with fewer than {} the method heuristic may need fewer steps than "
      "divide_and_conquer",
      regions, enough);
}

}  // namespace microswarm::navigation
