// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/rig_params.hpp"

#include "microswarm/config/yaml.hpp"

namespace microswarm {

Rig read_rig(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  Places places;
  auto params = read_yaml_file<RigParams>(file, settings, places);
  const std::filesystem::path coils = file.parent_path() / params.coils;
  return {std::move(params), read_coil_system(coils), file.parent_path()};
}

}  // namespace microswarm
