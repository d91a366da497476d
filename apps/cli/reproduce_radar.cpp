// SPDX-License-Identifier: Apache-2.0
#include "reproduce_radar.hpp"

#include <array>
#include <filesystem>

#include "reproduce_figures.hpp"
#include "reproduce_radar_safety.hpp"

namespace microswarm::cli {

namespace fs = std::filesystem;

RadarSetting load_radar(const ReproduceOptions& options, const char* name) {
  const fs::path file = options.scenarios / "papers" / "radar" / name;
  Scene scene = load_scene(read_scenario(file), file.parent_path());
  World world = build_world(scene);
  check(scene.scenario, world, file.string());
  return {std::move(scene), std::move(world)};
}

std::vector<ReproduceRow> reproduce_radar(const std::string& figure,
                                          const ReproduceOptions& options, const Stop& stop) {
  constexpr std::array<Figure, 8> figures{{{"fig5-6", radar_single},
                                           {"fig7", radar_series},
                                           {"fig8", radar_twelve},
                                           {"fig10", radar_experiment},
                                           {"fig11-12", radar_twelve_experiment},
                                           {"fig13", radar_micromaze},
                                           {"safety", radar_safety},
                                           {"fast", radar_fast}}};
  return reproduce_figures("radar", figures, figure, options, stop);
}

}  // namespace microswarm::cli
