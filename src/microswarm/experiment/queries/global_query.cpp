// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/queries/global_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/experiment/scenario/validate_robots.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::experiment {
namespace {

/// Throws InputError if no plan can exist.
void explain(const Map& map, const GlobalQuery& query, const planning::GlobalPlay& play,
             Status status, const std::string& name) {
  const Snapshot world = Snapshot::of(map);
  const bool starts_wrong = status == Status::start_blocked;
  if (!starts_wrong && status != Status::goal_blocked) return;
  const std::vector<Vec2>& wrong = starts_wrong ? query.starts : query.goals;
  const char* what = starts_wrong ? "start" : "goal";
  for (std::size_t i = 0; i < wrong.size(); ++i)
    if (const std::string why = world.blocked_reason(wrong[i], 0); !why.empty())
      throw InputError(name, fmt::format("robot {}: {} {}", i + 1, what, why));
  if (play.separation > 0)
    throw InputError(name,
                     fmt::format("two {}s are nearer to each other than separation_um {:g}{}", what,
                                 play.separation, starts_wrong ? "" : " and the tolerance allow"));
  throw InputError(name, fmt::format("a {} is too near a wall", what));
}

void search(const Map& map, const GlobalQuery& query, const planning::GlobalSearchParams& params,
            Rng& rng, const Stop& stop, GlobalAnswer& made) {
  planning::GlobalSearch found =
      planning::global_search(map, query.starts, query.goals, params, rng, stop);
  made.plan = std::move(found.plan);
  made.nodes = found.counts.samples;
}

void grow(const Map& map, const GlobalQuery& query, const planning::GlobalRrtParams& params,
          Rng& rng, const Stop& stop, GlobalAnswer& made) {
  planning::GlobalRrt grown =
      planning::global_rrt(map, query.starts, query.goals, params, rng, stop);
  made.plan.status = grown.answer.status;
  made.nodes = grown.tree.size();
  if (grown.tree.size() == 0 || grown.answer.status == Status::goal_blocked) return;
  if (!query.goals.empty()) made.plan = planning::plan_to(grown.tree, grown.answer);
  if (query.keep_tree) made.tree = std::move(grown.tree);
}

void check_finite(std::span<const Vec2> positions, const char* what, const std::string& name) {
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (!is_finite(positions[i]))
      throw InputError(name, fmt::format("robot {}: {} must be finite numbers", i + 1, what));
}

}  // namespace

std::string GlobalAnswer::why_none() const {
  if (plan.status == Status::solved) return {};
  const std::string word(to_string(plan.status));
  if (plan.status != Status::node_limit) return word;
  const int limit = std::visit([](const auto& p) { return p.max_nodes; }, planner);
  return fmt::format("{}: {} nodes of at most max_nodes {}", word, nodes, limit);
}

planning::GlobalPlay to_play(const GlobalPlannerParams& planner) {
  return std::visit(
      [](const auto& p) {
        return planning::GlobalPlay{p.robostep, p.contact, p.separation, p.goal_tolerance};
      },
      planner);
}

void check_ends(const Map& map, std::span<const Vec2> starts, std::span<const Vec2> goals,
                const planning::GlobalPlay& play, const std::string& name) {
  if (goals.size() != starts.size()) return;
  KeyLocations(name).require_none(validate_robot_paths(map, starts, goals, play.goal_tolerance, 0));
}

GlobalAnswer answer(const Map& map, const GlobalQuery& query, const std::string& name,
                    const Stop& stop) {
  GlobalChoice choice;
  if (query.keep_tree) {
    planning::GlobalRrtParams grown;
    grown.stop_at_first = false;
    choice.planner = grown;
  }
  GlobalAnswer made;
  made.notes = set_values(choice, query.settings);
  made.planner = choice.planner;
  const planning::GlobalPlay play = to_play(made.planner);
  check_finite(query.starts, "start", name);
  check_finite(query.goals, "goal", name);
  check_ends(map, query.starts, query.goals, play, name);
  if (query.keep_tree && !std::holds_alternative<planning::GlobalRrtParams>(made.planner))
    throw InputError("global: " + input_name("save_tree") + " needs planner.type=global_rrt");
  Rng rng(query.seed, Purpose::planner);
  const auto began = Stop::Clock::now();
  std::visit(
      Overloaded{
          [&](const planning::GlobalRrtParams& p) { grow(map, query, p, rng, stop, made); },
          [&](const planning::GlobalSearchParams& p) { search(map, query, p, rng, stop, made); }},
      made.planner);
  made.seconds = seconds_since(began);
  explain(map, query, play, made.plan.status, name);
  made.inputs_found = made.plan.inputs.size();
  if (query.shorten) made.plan = planning::shortened(map, made.plan, query.goals, play, stop);
  return made;
}

}  // namespace microswarm::experiment
