// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::navigation {

/// Constants of ConvexOutliner that rarely need a change. Hollow is the fraction of a hull that is
/// not in the body.
struct ConvexOutlineTuning {
  double ignored_hollow = 0.02;
  double max_hollow = 0.4;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.ignored_hollow,
          plain("ignored_hollow", 0, 1, "Hollow share up to which the hull always serves."));
    visit(self.max_hollow,
          plain("max_hollow", 0, 1, "Hollow share above which the hull never serves."));
  }
};

}  // namespace microswarm::navigation
