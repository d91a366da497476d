// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "microswarm/config/former_keys.hpp"
#include "microswarm/config/settings.hpp"
#include "microswarm/experiment/queries/planner_choice.hpp"
#include "microswarm/planning/global_input/global_rrt.hpp"
#include "microswarm/planning/global_input/global_search.hpp"
#include "microswarm/planning/global_input/global_shorten.hpp"

namespace microswarm::experiment {

/// Planners of inputs for several robots.
using GlobalPlannerParams = std::variant<planning::GlobalSearchParams, planning::GlobalRrtParams>;

/// Values that the settings of a query may change.
using GlobalChoice = PlannerChoice<GlobalPlannerParams>;

/// Query for global inputs that bring each robot to its own goal.
struct GlobalQuery {
  std::vector<Vec2> starts{};  ///< [µm]
  std::vector<Vec2> goals{};   ///< [µm], in the same order
  Settings settings{};         ///< of keys within `planner`
  std::uint64_t seed = 1;
  bool shorten = true;     ///< remove superfluous inputs
  bool keep_tree = false;  ///< grow a tree to its limits and keep it; goals may then be missing
};

/// The answer to a query.
struct GlobalAnswer {
  planning::GlobalPlan plan{};
  GlobalPlannerParams planner{};               ///< parameters that were used
  std::optional<planning::GlobalTree> tree{};  ///< the grown tree, if requested
  std::uint64_t nodes = 0;
  std::size_t inputs_found = 0;  ///< number before superfluous ones were removed
  double seconds = 0;            ///< computing time of the planner [s]
  Notes notes{};                 ///< one for each former key in the settings

  /// Why there is no plan, as text; empty with one.
  std::string why_none() const;
};

/// Plans the inputs. `name` is the map's name in messages. Throws InputError for mistakes in the
/// settings, positions that are not finite, a number of goals other than that of robots, and if no
/// plan can exist: a robot or goal in a wall, robots too close, or a goal that is cut off.
GlobalAnswer answer(const Map& map, const GlobalQuery& query, const std::string& name,
                    const Stop& stop = {});

/// Execution of a planner's inputs, and their goals.
planning::GlobalPlay to_play(const GlobalPlannerParams& planner);

/// Throws InputError if a robot cannot reach its goal. Unequal numbers are left to the planner.
void check_ends(const Map& map, std::span<const Vec2> starts, std::span<const Vec2> goals,
                const planning::GlobalPlay& play, const std::string& name);

}  // namespace microswarm::experiment
