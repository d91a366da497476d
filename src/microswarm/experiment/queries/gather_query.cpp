// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/queries/gather_query.hpp"

#include <fmt/format.h>

#include <utility>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/scenario/map_scale.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/navigation/gathering/aggregation_check.hpp"
#include "microswarm/navigation/gathering/policies/published_scale.hpp"
#include "microswarm/world/connectivity/channel_width.hpp"

namespace microswarm::experiment {

GatherExperiment open_gathering(formats::MapParts map, formats::MapSpec spec,
                                const GatherQuery& query, const std::string& name) {
  for (const Setting& setting : query.settings.list)
    if (formats::is_of_map(setting))
      throw InputError(setting_location(query.settings.option, setting.key),
                       "the map is read already: give its keys where it is read");
  GatherExperiment made;
  Scene& scene = made.experiment.scene;
  Scenario& scenario = scene.scenario;
  scenario.name = std::filesystem::path(name).stem().string();
  scenario.map = std::move(spec);
  RobotSwarmParams& robots = scenario.robots.emplace();
  robots.count = query.starts.empty() ? query.robots : 0;
  robots.starts = query.starts;
  scenario.goal = query.goal;
  scenario.navigator = navigation::AggregationParams{};
  scenario.seed = query.seed;
  scene.map = std::move(map);
  const Notes of_map = scene.map.notes;
  const World world = build_world(scene);
  if (const std::string why = world.at(0).blocked_reason(query.goal, 0); !why.empty())
    throw InputError(name, fmt::format("goal {}", why));
  Rng rng(query.seed, Purpose::planner);
  made.measured_width = channel_width(*world.map, rng);
  fit_gathering(scenario, query.channel_width.value_or(made.measured_width),
                width_around(*world.map, query.goal), query.max_steps);
  made.notes = set_values(scenario, query.settings);
  made.notes.insert(made.notes.begin(), of_map.begin(), of_map.end());
  made.experiment.keys = name;
  made.experiment.keys.add_notes(of_map);
  made.experiment.keys.require_none(validate(scenario, world));
  made.experiment.world = world;
  return made;
}

std::vector<std::string> unmet_assumptions(const Scenario& scenario, const Map& map) {
  const auto* params = std::get_if<navigation::AggregationParams>(&scenario.navigator);
  if (!params || !scenario.goal) return {};
  Rng rng(scenario.seed, Purpose::scene);
  const double width =
      navigation::published_channel_width * navigation::published_scale(*params, map, rng);
  return navigation::unmet_assumptions(map, *scenario.goal, width);
}

}  // namespace microswarm::experiment
