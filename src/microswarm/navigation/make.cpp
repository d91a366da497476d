// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/make.hpp"

namespace microswarm {

double margin_of(const NavigatorParams& params) {
  return std::visit([](const auto& p) { return p.margin; }, params);
}

double frame_timeout_of(const NavigatorParams& params) {
  return std::visit([](const auto& p) { return p.frame_timeout; }, params);
}

std::unique_ptr<Navigator> make_navigator(const NavigatorParams& params, const RibbonParams& swarm,
                                          Vec2 goal, double goal_tolerance, Rng rng) {
  return std::visit(
      [&](const HierarchicalParams& p) -> std::unique_ptr<Navigator> {
        return std::make_unique<HierarchicalNavigator>(p, swarm, goal, goal_tolerance, rng);
      },
      params);
}

}  // namespace microswarm
