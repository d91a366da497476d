// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/map_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
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

namespace microswarm::formats {
namespace {

namespace fs = std::filesystem;

MapParts to_parts(const Mask& blocked, double cell, Vec2 lo = {}) {
  return {cell_bounds(blocked, cell, lo), mask_walls(blocked, cell, lo), {}};
}

MapParts read(const ImageMap& spec, const fs::path& base, Issues&) {
  const Image image = read_image(base / spec.file);
  const bool dark_is_wall = spec.free == FreePixels::bright;
  MapParts parts = to_parts(threshold(image, spec.threshold, dark_is_wall), spec.um_per_px);
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
  return to_parts(ros_walls(image, header, spec.unknown_free, transparent),
                  header.resolution * spec.um_per_m, spec.um_per_m * origin);
}

MapParts read(const MovingAiMap& spec, const fs::path& base, Issues&) {
  return to_parts(read_moving_ai(base / spec.file), spec.um_per_cell);
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
  const Box around = enclosing_box(parts);
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
  for (Body& body : bodies) parts.walls.push_back(std::get<Polygon>(std::move(body.shape)));
  return parts;
}

/// Name of a kind of map file, and the extensions of such files.
struct FileFormat {
  std::string_view name;
  std::span<const std::string_view> extensions;
};

/// The format of a kind of map; nothing for one without a file.
std::optional<FileFormat> file_format(const MapSpec& spec) {
  static constexpr std::array<std::string_view, 2> csv{".csv", ".txt"}, ros{".yaml", ".yml"},
      geojson{".geojson", ".json"};
  static constexpr std::array<std::string_view, 1> moving_ai{".map"};
  using Format = std::optional<FileFormat>;
  return std::visit(Overloaded{[](const OneOf<PolygonsMap, ChannelMap> auto&) { return Format(); },
                               [](const ImageMap&) {
                                 return Format({"picture", image_extensions});
                               },
                               [](const RosMap&) {
                                 return Format({"ROS .yaml", ros});
                               },
                               [](const MovingAiMap&) {
                                 return Format({"MovingAI .map", moving_ai});
                               },
                               [](const GeoJsonMap&) {
                                 return Format({"GeoJSON", geojson});
                               },
                               [](const RectanglesMap&) {
                                 return Format({"CSV of rectangles", csv});
                               }},
                    spec);
}

/// A map of each kind.
std::vector<MapSpec> every_kind() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return std::vector<MapSpec>{std::variant_alternative_t<I, MapSpec>{}...};
  }
  (std::make_index_sequence<std::variant_size_v<MapSpec>>());
}

/// Sets the scale of a map whose file is set; `option` gave it, and `fail` throws.
template <class Fail>
void set_scale(MapSpec& spec, std::optional<double> um_per_px, const std::string& option,
               Fail&& fail) {
  std::visit(Overloaded{[&](ImageMap& s) {
                          if (!um_per_px) fail("µm per px is missing: give " + option);
                          s.um_per_px = *um_per_px;
                        },
                        [&](RosMap& s) {
                          const RosHeader header = read_ros_header(s.file);
                          if (um_per_px) s.um_per_m = *um_per_px / header.resolution;
                        },
                        [&](MovingAiMap& s) { s.um_per_cell = um_per_px.value_or(1); },
                        [&](OneOf<GeoJsonMap, RectanglesMap, PolygonsMap, ChannelMap> auto&) {
                          if (um_per_px) fail("has no pixels: leave out " + option);
                        }},
             spec);
}

}  // namespace

std::string* file_name(MapSpec& spec) {
  return std::visit(
      Overloaded{[](OneOf<ImageMap, RosMap, MovingAiMap, GeoJsonMap, RectanglesMap> auto& s) {
                   return &s.file;
                 },
                 [](OneOf<PolygonsMap, ChannelMap> auto&) -> std::string* { return nullptr; }},
      spec);
}

const std::string* file_name(const MapSpec& spec) { return file_name(const_cast<MapSpec&>(spec)); }

MapParts read_map_parts(const MapSpec& spec, const fs::path& base, Issues& issues) {
  const std::string* file = file_name(spec);
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

std::string map_formats() {
  std::vector<std::string_view> names;
  for (const MapSpec& spec : every_kind())
    if (const auto format = file_format(spec)) names.push_back(format->name);
  const std::string_view last = names.back();
  names.pop_back();
  return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

MapSpec guess_map_spec(const fs::path& path, std::optional<double> um_per_px,
                       std::string_view option) {
  const std::string file = path.string();
  const auto fail = [&](const std::string& why) { throw InputError(file + ": " + why); };
  std::error_code error;
  if (!fs::exists(path, error)) fail("cannot read: No such file or directory");
  if (um_per_px && !(*um_per_px >= 1e-6 && *um_per_px <= 1e6))
    fail("µm per px is " + number_text(*um_per_px) + ", must be within 1e-6..1e6");

  for (MapSpec& spec : every_kind()) {
    const auto format = file_format(spec);
    if (!format ||
        std::ranges::find(format->extensions, lower_extension(path)) == format->extensions.end())
      continue;
    *file_name(spec) = file;
    set_scale(spec, um_per_px, std::string(option), fail);
    return std::move(spec);
  }
  throw InputError(fmt::format("{}: no map that is known, expected: {}", file, map_formats()));
}

}  // namespace microswarm::formats
