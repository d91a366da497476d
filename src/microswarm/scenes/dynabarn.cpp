// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/dynabarn.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/text/csv.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::scenes {
namespace {

constexpr double um_a_metre = 100;
constexpr double obstacle_radius = 0.5 * um_a_metre;
constexpr double robot_radius = 0.3 * um_a_metre;
constexpr double dynabarn_time_limit = 100;  // [s]
constexpr double min_lap = 0.1;              // [s]
constexpr std::uint64_t max_dynabarn_bytes = 64 << 20;

/// Calls `take` with the cells of each row but the header.
template <class Take>
void for_each_row(const std::filesystem::path& file, std::size_t columns, Take&& take) {
  const std::string text = read_file(file, max_dynabarn_bytes);
  Lines lines(text, file.string());
  bool is_header = true;
  while (const std::optional<std::string_view> line = lines.next()) {
    if (trimmed(*line).empty() || std::exchange(is_header, false)) continue;
    const std::vector<std::string_view> cells = csv_cells(*line, ',');
    if (cells.size() != columns)
      lines.fail(std::to_string(cells.size()) + " cells, " + std::to_string(columns) + " expected");
    take(lines, cells);
  }
}

double dynabarn_number(const Lines& lines, std::string_view cell) {
  const std::optional<double> number = parse_number(cell);
  if (!number) lines.fail(quote(cell) + " is no number");
  return *number;
}

using Plugins = std::map<std::string, Samples, std::less<>>;

Plugins read_plugins(const std::filesystem::path& file) {
  Plugins plugins;
  for_each_row(file, 4, [&](const Lines& lines, const std::vector<std::string_view>& cells) {
    Samples& samples = plugins[std::string(cells[0])];
    const double t = dynabarn_number(lines, cells[1]);
    if (!samples.times.empty() && !(t > samples.times.back()))
      lines.fail("time " + std::string(cells[1]) + " does not ascend");
    samples.times.push_back(t);
    samples.points.push_back(
        um_a_metre * Vec2{dynabarn_number(lines, cells[2]), dynabarn_number(lines, cells[3])});
  });
  return plugins;
}

DynabarnLevel level_of(const Lines& lines, std::string_view plugin) {
  for (const auto& [level, name] : enum_names(DynabarnLevel()))
    if (plugin.starts_with(name)) return level;
  lines.fail(quote(plugin) + " is neither easy, medium nor hard");
}

/// The lap again and again, until the time limit. A disc disappears at the end of its lap and
/// appears at the begin: each lap has its own.
void add_laps(const Samples& lap, std::vector<Obstacle>& obstacles) {
  const double duration = lap.times.back() - lap.times.front();
  for (double begin = 0; begin <= dynabarn_time_limit; begin += duration) {
    Samples shifted = lap;
    for (double& t : shifted.times) t += begin - lap.times.front();
    shifted.times.back() = std::nextafter(shifted.times.back(), 0);  // then the next lap begins
    Track track{"tracks.csv", std::to_string(obstacles.size() + 1), {}};
    track.samples = std::make_shared<const Samples>(std::move(shifted));
    obstacles.push_back({DiscShape{obstacle_radius}, std::move(track)});
  }
}

}  // namespace

std::vector<DynabarnWorld> read_dynabarn(const std::filesystem::path& folder) {
  const Plugins plugins = read_plugins(folder / "tracks.csv");
  std::map<double, DynabarnWorld> worlds;
  for_each_row(
      folder / "worlds.csv", 2,
      [&](const Lines& lines, const std::vector<std::string_view>& cells) {
        DynabarnWorld& world = worlds[dynabarn_number(lines, cells[0])];
        const auto plugin = plugins.find(cells[1]);
        if (plugin == plugins.end()) lines.fail(quote(cells[1]) + " has no track");
        const std::vector<double>& times = plugin->second.times;
        if (!(times.back() - times.front() >= min_lap))
          lines.fail(quote(cells[1]) + " has a lap shorter than " + number_text(min_lap) + " s");
        world.level = level_of(lines, cells[1]);
        world.tracks.push_back(plugin->second);
      });
  std::vector<DynabarnWorld> out;
  out.reserve(worlds.size());
  for (auto& [number, world] : worlds) out.push_back(std::move(world));
  return out;
}

experiment::Scenario dynabarn_scenario(const DynabarnWorld& world, double speed) {
  experiment::Scenario s;
  formats::PolygonsMap map;
  map.lo = {-1200, -1200};
  map.hi = {1200, 1200};
  s.map = std::move(map);
  s.swarm = VortexParams{.radius = robot_radius, .moving_radius = robot_radius, .max_speed = speed};
  s.start = Pose2{{11 * um_a_metre, 0}, pi};
  s.goal = Vec2{-9 * um_a_metre, 0};
  s.goal_tolerance = um_a_metre;
  s.time_limit = dynabarn_time_limit;
  s.hold_limit = dynabarn_time_limit;
  s.stop_at_contact = true;
  for (const Samples& lap : world.tracks) add_laps(lap, s.obstacles);
  return s;
}

}  // namespace microswarm::scenes
