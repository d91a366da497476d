// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/edge_meetings.hpp"

#include <algorithm>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/geometry/predicates.hpp"
#include "microswarm/geometry/touching_edges.hpp"

namespace microswarm {
namespace {

// Compared pairs, a few ns each: many are within a second, most within some seconds.
constexpr std::size_t usual_pairs_per_edge = 64;
constexpr std::size_t usual_pairs = 1'000'000;
constexpr std::size_t most_pairs = 200'000'000;

Box box_of(const Segment& e) {
  Box box;
  box.include(e.a);
  box.include(e.b);
  return box;
}

}  // namespace

bool for_each_meeting(const EdgeGrid& grid,
                      const std::function<bool(std::size_t, std::size_t)>& visit) {
  const std::size_t count = grid.size(), max_meetings = max_edge_meetings(count);
  std::size_t compared = 0, meetings = 0;
  bool wanted = true, was_swept = false;
  for (std::size_t i = 0; i < count && wanted; ++i) {
    const Segment& e = grid.edge(i);
    grid.for_each_in(box_of(e), [&](std::size_t j) {
      ++compared;
      if (j <= i || !wanted || meetings > max_meetings || !intersects(e, grid.edge(j))) return;
      ++meetings;
      wanted = visit(i, j);
    });
    if (meetings > max_meetings || (was_swept && compared > most_pairs)) return false;
    if (was_swept || !wanted || compared <= usual_pairs + usual_pairs_per_edge * count) continue;
    was_swept = true;
    const auto pairs = find_touching_edges(grid.edges(), max_meetings);
    if (!pairs) continue;
    const auto rest = std::ranges::upper_bound(*pairs, i, {}, &EdgePair::first);
    std::all_of(rest, pairs->end(), [&](const EdgePair& p) { return visit(p.first, p.second); });
    return true;
  }
  return true;
}

void fail_too_many_meetings(std::size_t edges) {
  throw InputError("the walls have " + std::to_string(edges) +
                   " edges that cross or touch too often, at most " +
                   std::to_string(max_edge_meetings(edges)) + " times");
}

}  // namespace microswarm
