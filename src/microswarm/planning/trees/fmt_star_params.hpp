// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/planning/trees/rrt_params.hpp"

namespace microswarm::planning {

/// FMT*, the Fast Marching Tree (Janson et al. 2015, reference 46 of [radar]). A tree marches from
/// the start, in the order of cost-to-come, over a set of free samples. Every sample and every edge
/// keeps at least the clearance, as in Eq 28 [radar]. The path ends at the first node within the
/// goal tolerance that is the cheapest open one. If the tree ends before the goal, the sample set
/// is doubled, up to `max_nodes`. With `max_nodes` equal to `samples` there is only one set, as
/// published.
struct FmtStarParams {
  static constexpr std::string_view type_name = "fmt_star";
  double clearance = 40;
  double goal_tolerance = 50;
  int samples = 1000;          // n
  double radius_factor = 1.1;  // 1 + η
  int max_nodes = 64'000;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, tree_fields::clearance);
    visit(self.goal_tolerance, tree_fields::goal_tolerance);
    visit(self.samples, plain("samples", 1, 1e7, "Initial number of free samples (n)."));
    visit(self.radius_factor,
          plain("radius_factor", 1, 100, "Connection radius over the theoretical minimum."));
    visit(self.max_nodes,
          plain("max_nodes", 1, 1e7, "Maximum number of samples; doubled until a path is found."));
  }
};

/// Reports an issue if `max_nodes` is less than `samples`.
Issues validate(const FmtStarParams& params);

}  // namespace microswarm::planning
