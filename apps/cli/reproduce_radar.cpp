// SPDX-License-Identifier: Apache-2.0
#include "reproduce_radar.hpp"

#include <fmt/ranges.h>

#include <array>
#include <filesystem>

#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"
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

Record record_of(const RadarSetting& setting, const Stop& stop) {
  Recorder recorder(setting.scene);
  RunListener* const listeners[] = {&recorder};
  simulate(setting.scene.scenario, setting.world, 0, listeners, stop);
  return recorder.take();
}

std::vector<ReproduceRow> reproduce_radar(const std::string& figure,
                                          const ReproduceOptions& options, const Stop& stop) {
  using Make = std::vector<ReproduceRow> (*)(const ReproduceOptions&, const Stop&);
  constexpr std::array<std::pair<std::string_view, Make>, 8> figures{
      {{"fig5-6", radar_single},
       {"fig7", radar_series},
       {"fig8", radar_twelve},
       {"fig10", radar_experiment},
       {"fig11-12", radar_twelve_experiment},
       {"fig13", radar_micromaze},
       {"safety", radar_safety},
       {"fast", radar_fast}}};
  std::vector<ReproduceRow> rows;
  std::vector<std::string_view> names;
  bool known = figure.empty();
  for (const auto& [name, make] : figures) {
    names.push_back(name);
    if (!figure.empty() && figure != name) continue;
    known = true;
    const auto more = make(options, stop);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  if (!known)
    throw InputError(fmt::format("reproduce radar: unknown figure '{}', there are: {}", figure,
                                 fmt::join(names, ", ")));
  if (!options.out.empty())
    write_file_atomically(fs::path(options.out) / "radar.csv", rows_csv(rows));
  return rows;
}

}  // namespace microswarm::cli
