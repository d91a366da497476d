// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/params.hpp"

#include <type_traits>

namespace microswarm {
namespace {

constexpr double range_of_others = 50;  // [µm]; see detection_range_of

double clearance(const HierarchicalParams& p) { return p.clearance; }
template <class Others>
double clearance(const Others&) {
  return 0;
}

}  // namespace

NavigatorParams in_effect(const NavigatorParams& params) {
  return std::visit(
      [](const auto& p) -> NavigatorParams {
        if constexpr (requires { p.in_effect(); }) return p.in_effect();
        return p;
      },
      params);
}

double required_clearance(const NavigatorParams& params) {
  return std::visit([](const auto& p) { return clearance(p); }, params);
}

double detection_range_of(const NavigatorParams& params) {
  return std::visit(
      [](const auto& p) {
        if constexpr (requires { p.detection_range; }) return p.detection_range;
        return range_of_others;
      },
      params);
}

namespace {

template <class Params>
auto* follower_in(Params& params) {
  using Follower =
      std::conditional_t<std::is_const_v<Params>, const FollowerParams, FollowerParams>;
  return std::visit(
      [](auto& p) -> Follower* {
        if constexpr (requires { p.follower; }) return &p.follower;
        return nullptr;
      },
      params);
}

}  // namespace

const FollowerParams* follower_of(const NavigatorParams& params) { return follower_in(params); }
FollowerParams* follower_of(NavigatorParams& params) { return follower_in(params); }

}  // namespace microswarm
