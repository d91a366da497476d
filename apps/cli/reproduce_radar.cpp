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

namespace {

/// What there is of a figure that was not finished: it has no aims to meet.
std::vector<ReproduceRow> interrupted(std::string_view figure, std::vector<ReproduceRow> rows) {
  fmt::print(stderr, "{}: interrupted\n", figure);
  if (rows.empty()) rows.push_back({.figure = std::string(figure), .quantity = "interrupted"});
  for (ReproduceRow& row : rows) {
    row.aim.reset();
    row.note = row.note.empty() ? "interrupted" : row.note + ", interrupted";
  }
  return rows;
}

}  // namespace

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
    if (stop()) continue;
    auto more = make(options, stop);
    if (stop()) more = interrupted(name, std::move(more));
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
