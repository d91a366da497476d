// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/queries/path_query.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/experiment/queries/planner_choice.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/path/fit_to_map.hpp"
#include "microswarm/planning/path/planners.hpp"

namespace microswarm::experiment {
namespace {

using PathChoice = PlannerChoice<planning::PlannerParams>;

/// Throws InputError if the planner's parameters are inconsistent.
void check_planner(const planning::PlannerParams& planner, const KeyLocations& keys) {
  const Issues issues = std::visit(
      Overloaded{
          [](const planning::FmtStarParams& p) { return validate(p); },
          [&](const planning::DrrtStarParams& p) {
            return validate(p, given_within(keys.is_given(), "planner"));
          },
          [](const OneOf<planning::ExactParams, planning::AStarParams, planning::ThetaStarParams,
                         planning::RrtParams, planning::RrtConnectParams, planning::RrtStarParams,
                         planning::UniformRrtStarParams> auto&) { return Issues(); }},
      planner);
  Issues of_planner;
  of_planner.add_within("planner", issues, "planner");
  keys.require_none(of_planner);
}

/// Throws InputError if no path can exist.
void explain(const Snapshot& world, const PathQuery& query, const std::string& name,
             const planning::PlannerParams& planner, Status status) {
  const auto [clearance, tolerance] = path_limits(planner);
  const Vec2 start = query.start.position;
  if (status == Status::start_blocked)
    throw InputError(name, fmt::format("start {}", world.blocked_reason(start, clearance)));
  if (status == Status::goal_blocked)
    throw InputError(name, fmt::format("goal {}", world.blocked_reason(query.goal, clearance)));
  if (status != Status::no_path && status != Status::node_limit) return;
  if (const auto target = planning::free_goal(world, query.goal, tolerance, clearance))
    KeyLocations(name).require_none(validate_path(world.map(), start, *target, clearance));
}

/// Notes a path that ends beside its goal because walls are near.
void note_goal(const Snapshot& world, const PathQuery& query, PathAnswer& made) {
  const std::string why = world.blocked_reason(query.goal, path_limits(made.planner).clearance);
  if (made.plan.status != Status::solved || why.empty()) return;
  made.notes.push_back(fmt::format("goal {}: the path ends {:.3g} µm before it", why,
                                   distance(made.plan.path.back(), query.goal)));
}

}  // namespace

PathLimits path_limits(const planning::PlannerParams& planner) {
  return std::visit(
      [](const auto& p) {
        return PathLimits{p.clearance, p.goal_tolerance};
      },
      planner);
}

std::string planner_json(const planning::PlannerParams& planner) {
  return nlohmann::ordered_json::parse(to_json_text(PathChoice{planner}))["planner"].dump();
}

std::string PathAnswer::why_none() const {
  if (plan.status == Status::solved) return {};
  const std::string word(to_string(plan.status));
  if (plan.status != Status::node_limit) return word;
  return fmt::format("{}: {}", word, planning::limit_text(planner, plan.counts));
}

const Type& path_settings() { return type_of<PathChoice>(); }

PathAnswer answer(const Snapshot& world, const PathQuery& query, const std::string& name,
                  const Stop& stop) {
  for (const double v : {query.start.position.x, query.start.position.y, query.start.heading,
                         query.goal.x, query.goal.y})
    if (!std::isfinite(v)) throw InputError("start and goal must be finite numbers");
  PathAnswer made;
  PathChoice choice;
  made.notes = set_values(choice, query.settings);
  const KeyLocations keys = find_locations({}, "plan", query.settings);
  check_planner(choice.planner, keys);
  made.planner =
      planning::fit_to_map(choice.planner, world.map(), given_within(keys.is_given(), "planner"));
  const std::string why = world.blocked_reason(query.goal, 0);
  if (!why.empty() && world.is_free(query.start.position, 0))  // else the start is named
    throw InputError(name, fmt::format("goal {}", why));
  Rng rng(query.seed, Purpose::planner);
  const auto began = Stop::Clock::now();
  made.plan = plan(world, query.start, query.goal, made.planner, rng, stop);
  made.seconds = seconds_since(began);
  explain(world, query, name, made.planner, made.plan.status);
  note_goal(world, query, made);
  return made;
}

}  // namespace microswarm::experiment
