// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/fit_clearance.hpp"

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "tests/messages.hpp"

namespace microswarm::experiment {
namespace {

// A passage of 60 µm, three cells of a grid map.
std::string lanes_text(const std::string& navigator) {
  return R"(
map:
  type: polygons
  hi_um: [600, 400]
  walls_um:
    - [[200, 0], [220, 0], [220, 180], [200, 180]]
    - [[200, 240], [220, 240], [220, 400], [200, 400]]
start: {x_um: 60, y_um: 200}
goal_um: [540, 200]
goal_tolerance_um: 20
swarm: {type: ribbon, radius_um: 10}
navigator: )" +
         navigator;
}

TEST(FitClearance, OfDrrtStarToTheMapUnlessItIsGiven) {
  const auto opened = [](const std::string& navigator) {
    return open_experiment_text(lanes_text(navigator), "s.yaml", ".");
  };
  const auto clearance = [](const Experiment& experiment) {
    return std::get<navigation::HierarchicalParams>(experiment.scenario().navigator).clearance;
  };
  const Experiment fitted = opened("{type: hierarchical_drrt_star}");
  EXPECT_LE(clearance(fitted), 30);
  EXPECT_GE(clearance(fitted), 0.96 * 30);
  ASSERT_EQ(fitted.keys.notes().size(), 1u);
  EXPECT_TRUE(test::is_one_line_naming(fitted.keys.notes()[0], "",
                                       {"navigator.clearance_um", "90", "passages"}));
  const Experiment given = opened("{type: hierarchical_drrt_star, clearance_um: 20}");
  EXPECT_EQ(clearance(given), 20);
  EXPECT_TRUE(given.keys.notes().empty());
  EXPECT_THROW(opened("{type: hierarchical_drrt_star, clearance_um: 90}"), InputError);
  EXPECT_THROW(opened("{type: hierarchical_drrt_star, as_published: true}"), InputError);
}

}  // namespace
}  // namespace microswarm::experiment
