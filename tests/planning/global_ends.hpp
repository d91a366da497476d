// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/scenes/global_worlds.hpp"

namespace microswarm::planning {

/// Starts and goals of the first `n` robots.
inline std::span<const Vec2> starts(std::size_t n) { return {scenes::global_starts.data(), n}; }
inline std::span<const Vec2> goals(std::size_t n) { return {scenes::global_goals.data(), n}; }

}  // namespace microswarm::planning
