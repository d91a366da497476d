// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "microswarm/core/fields.hpp"

namespace microswarm {

class FollowerModel;

/// How a path is followed.
enum class FollowerKind {
  pure_pursuit,  ///< heads for a point of the path ahead
  learned        ///< a network taught by an expert [drrt]
};
constexpr auto enum_names(FollowerKind) {
  return std::array<std::pair<FollowerKind, std::string_view>, 2>{
      {{FollowerKind::pure_pursuit, "pure_pursuit"}, {FollowerKind::learned, "learned"}}};
}

/// Which follower a navigator has. The flow is told from what is seen; a model always knows it.
struct FollowerParams {
  FollowerKind kind = FollowerKind::pure_pursuit;
  bool correct_flow = false;
  std::string model;
  std::shared_ptr<const FollowerModel> loaded;  ///< what the file `model` holds
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.kind, {"kind", Unit::none, {}, "Kind of the follower: pure_pursuit or learned."});
    visit(self.correct_flow,
          {"correct_flow", Unit::none, {}, "Pure pursuit compensates the observed drift."});
    visit(self.model,
          {"model", Unit::none, {}, "File of a learned follower; none: the built-in one."});
  }
};

}  // namespace microswarm
