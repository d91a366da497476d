// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Pair of edges by index, the lower one first.
using EdgePair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs of edges that share a point, in order. Nothing if two edges cross within both, or if there
/// are more than `max_pairs`. A sweep in n log n steps, however long the edges are. Exact, also for
/// collinear and degenerate edges. Source: Shamos & Hoey 1976.
std::optional<std::vector<EdgePair>> find_touching_edges(std::span<const Segment> edges,
                                                         std::size_t max_pairs);

}  // namespace microswarm
