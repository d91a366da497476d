// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <variant>

#include "microswarm/navigation/hierarchical.hpp"

namespace microswarm {

/// Any navigator, chosen at run time by its `type`.
using NavigatorParams = std::variant<HierarchicalParams>;

/// Least distance [µm] from its centre that the navigator keeps for the swarm.
double margin_of(const NavigatorParams& params);

/// Age [s] from which on the navigator holds a frame for too old.
double frame_timeout_of(const NavigatorParams& params);

/// The navigator with these parameters for a swarm of which `swarm` is known.
std::unique_ptr<Navigator> make_navigator(const NavigatorParams& params, const RibbonParams& swarm,
                                          Vec2 goal, double goal_tolerance, Rng rng);

}  // namespace microswarm
