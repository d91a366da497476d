// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/scenario.hpp"

#include "microswarm/config/key_locations.hpp"
#include "microswarm/config/schema.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"

namespace microswarm::experiment {

Scenario read_scenario(const std::filesystem::path& file, const Settings& settings,
                       KeyLocations& keys) {
  return read_yaml_file<Scenario>(file, settings, keys);
}

Scenario read_scenario(const std::filesystem::path& file, const Settings& settings) {
  KeyLocations keys;
  return read_scenario(file, settings, keys);
}

Scenario read_scenario(const std::filesystem::path& file) {
  return read_scenario(file, Settings());
}

std::string scenario_text(const Scenario& scenario) {
  Scenario out = scenario;
  out.navigator = navigation::in_effect(out.navigator);
  return to_yaml(out);
}

std::string scenario_schema() { return json_schema<Scenario>("microswarm scenario"); }

}  // namespace microswarm::experiment

namespace microswarm {

template const Type& type_of<experiment::Scenario>();

}  // namespace microswarm
