// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/map_file.hpp"

#include <algorithm>
#include <cctype>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/geojson.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/formats/moving_ai.hpp"
#include "microswarm/formats/rectangles.hpp"
#include "microswarm/formats/ros.hpp"
#include "microswarm/world/obstacles/channel.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"

namespace microswarm {
namespace {

namespace fs = std::filesystem;

MapParts parts_of(const Mask& blocked, double cell, Vec2 lo = {}) {
  return {cell_bounds(blocked, cell, lo), mask_walls(blocked, cell, lo), {}};
}

MapParts read(const ImageMap& spec, const fs::path& base, Issues&) {
  const Image image = read_image(base / spec.file);
  const bool dark_is_wall = spec.free == FreePixels::bright;
  MapParts parts = parts_of(threshold(image, spec.threshold, dark_is_wall), spec.um_per_px);
  simplify(parts.walls, spec.simplify);
  return parts;
}

MapParts read(const RosMap& spec, const fs::path& base, Issues&) {
  const fs::path yaml = base / spec.file;
  const RosHeader header = read_ros_header(yaml);
  const fs::path picture = yaml.parent_path() / header.image;
  const Image image = read_image(picture);
  const auto transparent = read_transparency(picture);
  const Vec2 origin{header.origin[0], header.origin[1]};
  return parts_of(ros_walls(image, header, spec.unknown_free, transparent),
                  header.resolution * spec.um_per_m, spec.um_per_m * origin);
}

MapParts read(const MovingAiMap& spec, const fs::path& base, Issues&) {
  return parts_of(read_moving_ai(base / spec.file), spec.um_per_cell);
}

MapParts read(const GeoJsonMap& spec, const fs::path& base, Issues&) {
  return read_geojson(base / spec.file, spec.um_per_unit);
}

MapParts read(const RectanglesMap& spec, const fs::path& base, Issues& issues) {
  MapParts parts;
  for (std::size_t i = 0; i < spec.rectangles.size(); ++i)
    attempt(issues, "map.rectangles_um." + std::to_string(i), [&] {
      parts.walls.push_back(
          rectangle(spec.rectangles[i], "map.rectangles_um[" + std::to_string(i) + "]"));
    });
  if (!spec.file.empty()) {
    std::vector<Polygon> more = read_rectangles(base / spec.file);
    std::move(more.begin(), more.end(), std::back_inserter(parts.walls));
  }
  const Box around = box_of(parts);
  parts.bounds = {spec.lo.value_or(around.lo), spec.hi.value_or(around.hi)};
  return parts;
}

MapParts read(const PolygonsMap& spec, const fs::path&, Issues& issues) {
  MapParts parts{{spec.lo, spec.hi}, {}, {}};
  for (std::size_t i = 0; i < spec.walls.size(); ++i) {
    Polygon wall = normalised({spec.walls[i], {}});
    if (wall.outer.empty() || signed_area(wall.outer) == 0)
      issues.add("map.walls_um." + std::to_string(i),
                 "map.walls_um[" + std::to_string(i) +
                     "]: at least 3 points with an area between them expected");
    parts.walls.push_back(std::move(wall));
  }
  for (const DiscWall& disc : spec.discs) parts.discs.push_back({disc.centre, disc.radius});
  return parts;
}

MapParts read(const ChannelMap& spec, const fs::path&, Issues& issues) {
  const Vec2 middle{spec.width / 2, spec.height / 2};
  DeformingChannel channel;
  for (const Vec2 p : spec.centre_line) channel.centre_line.push_back(p - middle);
  channel.half_width = spec.half_width;
  channel.end_half_width = spec.end_half_width;
  channel.end_length = spec.end_length;
  channel.amplitude = 0;
  channel.block_width = spec.width;
  channel.block_height = spec.height;
  issues.add_within("map", validate(channel), "map");
  if (!issues.empty()) return {};
  const Obstacle block{channel, Still{middle}};
  std::vector<Body> bodies;
  append_bodies(block, 0, 0, bodies);
  MapParts parts{{{0, 0}, {spec.width, spec.height}}, {}, {}};
  for (Body& body : bodies)
    if (auto* polygon = std::get_if<Polygon>(&body.shape))
      parts.walls.push_back(std::move(*polygon));
  return parts;
}

/// File of the map, or null if it has none.
const std::string* file_of(const MapSpec& spec) {
  return std::visit(
      [](const auto& s) -> const std::string* {
        if constexpr (requires { s.file; })
          return &s.file;
        else
          return nullptr;
      },
      spec);
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

RosMap guess_ros(const fs::path& path, std::optional<double> um_per_px) {
  const RosHeader header = read_ros_header(path);
  RosMap spec{.file = path.string()};
  if (um_per_px) spec.um_per_m = *um_per_px / header.resolution;
  return spec;
}

}  // namespace

MapParts read_map_parts(const MapSpec& spec, const fs::path& base, Issues& issues) {
  const std::string* file = file_of(spec);
  const bool from_file = file && !file->empty();
  Issues of_map;
  MapParts parts;
  // A map type chosen by --set may have no file.
  if (file && file->empty() && !std::holds_alternative<RectanglesMap>(spec))
    of_map.add("map.file", "missing key map.file");
  else
    attempt(of_map, from_file ? "map.file" : "map", [&] {
      parts = std::visit([&](const auto& s) { return read(s, base, of_map); }, spec);
      if (of_map.empty()) check(parts, from_file ? (base / *file).string() : "map");
    });
  issues.add(of_map);
  return parts;
}

MapParts read_map_parts(const MapSpec& spec, const fs::path& base, const KeyLocations& keys) {
  Issues issues;
  MapParts parts = read_map_parts(spec, base, issues);
  keys.require_none(issues);
  return parts;
}

LoadedMap load_map(const MapSpec& spec, const fs::path& base) {
  MapParts parts = read_map_parts(spec, base);
  const std::uint64_t hash = fingerprint(parts);
  return {std::make_shared<Map>(parts.bounds, std::move(parts.walls), std::move(parts.discs)),
          hash};
}

MapSpec guess_map_spec(const fs::path& path, std::optional<double> um_per_px) {
  const std::string file = path.string();
  const auto fail = [&](const std::string& why) { throw InputError(file + ": " + why); };
  std::error_code error;
  if (!fs::exists(path, error)) fail("cannot read: No such file or directory");
  if (um_per_px && !(*um_per_px >= 1e-6 && *um_per_px <= 1e6))
    fail("µm per px is " + number_text(*um_per_px) + ", must be within 1e-6..1e6");

  const std::string extension = lower_case(path.extension().string());
  if (is_one_of(extension, {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".pgm", ".ppm",
                            ".pbm", ".pnm"})) {
    if (!um_per_px) fail("µm per px is missing: give --um-per-px");
    return ImageMap{.file = file, .um_per_px = *um_per_px};
  }
  if (is_one_of(extension, {".yaml", ".yml"})) return guess_ros(path, um_per_px);
  if (extension == ".map") return MovingAiMap{.file = file, .um_per_cell = um_per_px.value_or(1)};
  const bool is_geojson = is_one_of(extension, {".geojson", ".json"});
  if (!is_geojson && !is_one_of(extension, {".csv", ".txt"}))
    fail("no map that is known: a picture, ROS .yaml, MovingAI .map, GeoJSON or a .csv expected");
  if (um_per_px) fail("has no pixels: leave out --um-per-px");
  if (is_geojson) return GeoJsonMap{.file = file};
  return RectanglesMap{.file = file};
}

}  // namespace microswarm
