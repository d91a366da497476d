// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/record_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/navigation/following/follower_model.hpp"

namespace microswarm::experiment {

namespace {

using Offsets = std::vector<std::int64_t>;

/// Navigator of 0.2.0.
constexpr std::string_view gone_navigator = "predictive";

/// Takes a navigator that is gone out of a scenario as the program writes it, and returns its name.
std::string take_gone_navigator(std::string& scenario) {
  const std::string head = fmt::format("\nnavigator:\n  type: {}\n", gone_navigator);
  const std::size_t begin = scenario.find(head);
  if (begin == std::string::npos) return {};
  std::size_t end = begin + head.size();
  while (scenario.compare(end, 2, "  ") == 0)
    end = std::min(scenario.find('\n', end), scenario.size() - 1) + 1;
  scenario.replace(begin, end - begin, "\nnavigator:\n  type: safe_interval\n");
  return std::string(gone_navigator);
}

void number_column(io::Hdf5Writer& out, const std::string& path, const std::vector<double>& values,
                   std::string_view unit) {
  out.dataset(path, values);
  out.attribute(path, "unit", unit);
}

void write_points(io::Hdf5Writer& out, const std::string& group, const std::vector<Vec2>& points) {
  std::vector<double> x, y;
  for (const Vec2 p : points) x.push_back(p.x), y.push_back(p.y);
  number_column(out, group + "/x_um", x, "µm");
  number_column(out, group + "/y_um", y, "µm");
}

std::vector<Vec2> read_points(const io::Hdf5Reader& in, const std::string& group) {
  const std::vector<double> x = in.numbers(group + "/x_um"), y = in.numbers(group + "/y_um");
  if (x.size() != y.size()) in.fail(group + ": x_um and y_um differ in length");
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], y[i]});
  return points;
}

/// Offsets of a list of lists with `count` entries in total.
Offsets read_offsets(const io::Hdf5Reader& in, const std::string& path, std::size_t count) {
  Offsets offsets = in.integers(path);
  if (offsets.empty() || offsets.front() != 0 ||
      offsets.back() != static_cast<std::int64_t>(count) ||
      !std::is_sorted(offsets.begin(), offsets.end()))
    in.fail(path + " does not fit what it divides");
  return offsets;
}

void write_walls(io::Hdf5Writer& out, const std::vector<Polygon>& walls) {
  std::vector<Vec2> points;
  Offsets ring_ends{0}, wall_ends{0};
  const auto add_ring = [&](const std::vector<Vec2>& ring) {
    points.insert(points.end(), ring.begin(), ring.end());
    ring_ends.push_back(static_cast<std::int64_t>(points.size()));
  };
  for (const Polygon& wall : walls) {
    add_ring(wall.outer);
    for (const auto& hole : wall.holes) add_ring(hole);
    wall_ends.push_back(static_cast<std::int64_t>(ring_ends.size()) - 1);
  }
  write_points(out, "/map/walls", points);
  out.dataset("/map/walls/ring_offset", ring_ends);
  out.attribute("/map/walls/ring_offset", "description",
                "Ring i owns the points ring_offset[i] to ring_offset[i + 1] - 1, from 0.");
  out.dataset("/map/walls/wall_offset", wall_ends);
  out.attribute("/map/walls/wall_offset", "description",
                "Wall i owns the rings wall_offset[i] to wall_offset[i + 1] - 1, from 0: the "
                "outline, then its holes.");
}

std::vector<Polygon> read_walls(const io::Hdf5Reader& in) {
  const std::vector<Vec2> points = read_points(in, "/map/walls");
  const Offsets rings = read_offsets(in, "/map/walls/ring_offset", points.size());
  const Offsets walls = read_offsets(in, "/map/walls/wall_offset", rings.size() - 1);
  std::vector<Polygon> polygons;
  for (std::size_t w = 0; w + 1 < walls.size(); ++w) {
    Polygon& polygon = polygons.emplace_back();
    for (std::int64_t r = walls[w]; r < walls[w + 1]; ++r) {
      const auto i = static_cast<std::size_t>(r);
      std::vector<Vec2> ring(points.begin() + rings[i], points.begin() + rings[i + 1]);
      (r == walls[w] ? polygon.outer : polygon.holes.emplace_back()) = std::move(ring);
    }
  }
  return polygons;
}

std::vector<Track*> find_tracks(std::vector<Obstacle>& obstacles) {
  std::vector<Track*> tracks;
  for (Obstacle& obstacle : obstacles)
    if (auto* track = find_track(obstacle.motion)) tracks.push_back(track);
  return tracks;
}

void write_tracks(io::Hdf5Writer& out, const std::vector<Obstacle>& obstacles) {
  std::vector<double> times;
  std::vector<Vec2> points;
  Offsets ends{0};
  for (const Obstacle& obstacle : obstacles) {
    const auto* track = find_track(obstacle.motion);
    if (!track) continue;
    if (track->samples) {
      times.insert(times.end(), track->samples->times.begin(), track->samples->times.end());
      points.insert(points.end(), track->samples->points.begin(), track->samples->points.end());
    }
    ends.push_back(static_cast<std::int64_t>(times.size()));
  }
  number_column(out, "/tracks/t_s", times, "s");
  write_points(out, "/tracks", points);
  out.dataset("/tracks/offset", ends);
  out.attribute(
      "/tracks/offset", "description",
      "The i-th obstacle that follows a track owns offset[i] to offset[i + 1] - 1, from 0.");
}

void read_track_samples(const io::Hdf5Reader& in, std::vector<Obstacle>& obstacles) {
  const std::vector<double> times = in.numbers("/tracks/t_s");
  const std::vector<Vec2> points = read_points(in, "/tracks");
  if (points.size() != times.size()) in.fail("/tracks: t_s and x_um differ in length");
  const Offsets ends = read_offsets(in, "/tracks/offset", times.size());
  const std::vector<Track*> tracks = find_tracks(obstacles);
  if (ends.size() != tracks.size() + 1) in.fail("/tracks does not fit the scenario's obstacles");
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Samples samples{{times.begin() + ends[i], times.begin() + ends[i + 1]},
                    {points.begin() + ends[i], points.begin() + ends[i + 1]}};
    if (!std::is_sorted(samples.times.begin(), samples.times.end()))
      in.fail("/tracks/t_s does not ascend");
    tracks[i]->samples = std::make_shared<const Samples>(std::move(samples));
  }
}

}  // namespace

void write_scene(io::Hdf5Writer& out, const Scene& scene) {
  out.text("/scenario", scenario_text(scene.scenario));
  out.attribute("/scenario", "description", "The scenario as YAML, every parameter written out.");
  const Box& bounds = scene.map.bounds;
  number_column(out, "/map/bounds_um", {bounds.lo.x, bounds.lo.y, bounds.hi.x, bounds.hi.y}, "µm");
  out.attribute("/map/bounds_um", "description", "Least x and y, greatest x and y.");
  write_walls(out, scene.map.walls);
  std::string notes;
  for (const std::string& note : scene.map.notes) notes += notes.empty() ? note : "\n" + note;
  if (!notes.empty()) out.attribute("/map", "notes", notes);
  std::vector<Vec2> centres;
  std::vector<double> radii;
  for (const Disc& disc : scene.map.discs)
    centres.push_back(disc.centre), radii.push_back(disc.radius);
  write_points(out, "/map/discs", centres);
  number_column(out, "/map/discs/radius_um", radii, "µm");
  write_tracks(out, scene.scenario.obstacles);
  if (const navigation::FollowerParams* follower =
          navigation::find_follower(scene.scenario.navigator);
      follower && follower->loaded)
    out.text("/follower_model", navigation::follower_model_text(*follower->loaded));
}

Scene read_scene(const io::Hdf5Reader& in, std::string& gone) {
  Scene scene;
  std::string scenario = in.text("/scenario");
  gone = take_gone_navigator(scenario);
  scene.scenario = read_yaml_text<Scenario>(scenario, in.name() + ":/scenario");
  const std::vector<double> bounds = in.numbers("/map/bounds_um");
  if (bounds.size() != 4) in.fail("/map/bounds_um has not 4 values");
  scene.map.bounds = {{bounds[0], bounds[1]}, {bounds[2], bounds[3]}};
  scene.map.walls = read_walls(in);
  const std::vector<Vec2> centres = read_points(in, "/map/discs");
  const std::vector<double> radii = in.numbers("/map/discs/radius_um");
  if (radii.size() != centres.size()) in.fail("/map/discs: x_um and radius_um differ in length");
  for (std::size_t i = 0; i < radii.size(); ++i) scene.map.discs.push_back({centres[i], radii[i]});
  formats::check(scene.map, in.name());
  read_track_samples(in, scene.scenario.obstacles);
  if (navigation::FollowerParams* follower = navigation::find_follower(scene.scenario.navigator);
      follower && !follower->model.empty())
    follower->loaded =
        std::make_shared<const navigation::FollowerModel>(navigation::parse_follower_model(
            in.text("/follower_model"), in.name() + ":/follower_model"));
  return scene;
}

}  // namespace microswarm::experiment
