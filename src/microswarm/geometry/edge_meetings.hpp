// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "microswarm/geometry/edge_grid.hpp"

namespace microswarm {

/// Calls visit(i, j), i < j, for every pair of the grid's edges that shares a point, in the order
/// of i, until it returns false. Long edges beside each other, of which the grid compares nearly
/// all pairs, are left to a sweep. Returns false if it gave up: edges cross, and some 10⁸ pairs
/// were not enough, or more pairs meet than max_edge_meetings.
bool for_each_meeting(const EdgeGrid& grid,
                      const std::function<bool(std::size_t, std::size_t)>& visit);

/// Throws InputError for `edges` edges of which too many meet.
[[noreturn]] void fail_too_many_meetings(std::size_t edges);

/// Pairs that may meet among `edges` edges.
constexpr std::size_t max_edge_meetings(std::size_t edges) { return 1'000'000 + 16 * edges; }

}  // namespace microswarm
