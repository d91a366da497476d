// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

struct FollowerModel;

/// Path-following method.
enum class FollowerKind {
  pure_pursuit,  ///< heads for a point of the path ahead
  learned        ///< network trained by imitation of an expert [drrt]
};
constexpr auto enum_names(FollowerKind) {
  return std::array<std::pair<FollowerKind, std::string_view>, 2>{
      {{FollowerKind::pure_pursuit, "pure_pursuit"}, {FollowerKind::learned, "learned"}}};
}

/// Follower of a navigator. The flow is estimated from observations; a learned follower always uses
/// it.
struct FollowerParams {
  FollowerKind kind = FollowerKind::pure_pursuit;
  bool correct_flow = false;
  std::string model{};
  std::shared_ptr<const FollowerModel> loaded{};  ///< contents of the file `model`
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.kind, plain("kind", "Kind of the follower: pure_pursuit or learned."));
    visit(self.correct_flow, plain("correct_flow", "Pure pursuit compensates the observed drift."));
    visit(self.model, plain("model", "File of a learned follower; none: the built-in one."));
  }
};

}  // namespace microswarm::navigation
