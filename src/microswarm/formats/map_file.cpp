// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/map_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <span>
#include <utility>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/input_folder.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/geojson.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/formats/map_extension.hpp"
#include "microswarm/formats/matrix.hpp"
#include "microswarm/formats/moving_ai.hpp"
#include "microswarm/formats/picture_walls.hpp"
#include "microswarm/formats/rectangles.hpp"
#include "microswarm/formats/ring_fault.hpp"
#include "microswarm/formats/ros.hpp"
#include "microswarm/formats/svg_walls.hpp"
#include "microswarm/formats/turn_map.hpp"
#include "microswarm/world/obstacles/channel.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"

namespace microswarm::formats {
namespace {

namespace fs = std::filesystem;

MapParts to_parts(const Mask& blocked, double cell, Vec2 lo = {}) {
  return {cell_bounds(blocked, cell, lo), mask_walls(blocked, cell, lo), {}};
}

MapParts read(const ImageMap& spec, const fs::path& base, Issues&) {
  const fs::path file = base / spec.file;
  ReadPicture picture = read_picture(file);
  MapParts parts = to_parts(picture_walls(picture.image, spec.threshold, spec.free, file.string()),
                            spec.um_per_px);
  parts.notes = std::move(picture.notes);
  if (parts.walls.empty())
    parts.notes.push_back(no_walls_note(spec.threshold, spec.free, file.string()));
  simplify(parts.walls, spec.simplify);
  return parts;
}

MapParts read(const SvgMap& spec, const fs::path& base, Issues&) {
  const fs::path file = base / spec.file;
  SvgWalls drawn = draw_svg_walls(spec, file);
  // The lowest pixels may reach below the drawing.
  MapParts parts = to_parts(drawn.walls, drawn.um_per_px,
                            {0, drawn.size.y - drawn.um_per_px * drawn.walls.height});
  parts.bounds = {{0, 0}, drawn.size};
  parts.notes = std::move(drawn.notes);
  if (parts.walls.empty())
    parts.notes.push_back(no_walls_note(spec.threshold, spec.free, file.string()));
  simplify(parts.walls, spec.simplify);
  return parts;
}

MapParts read(const MatrixMap& spec, const fs::path& base, Issues&) {
  const fs::path file = base / spec.file;
  Mask walls = read_matrix(file);
  const auto ones = std::ranges::count(walls.cells, 1);
  if (spec.wall.value_or(MatrixWall::zero) == MatrixWall::zero)
    for (std::uint8_t& cell : walls.cells) cell = cell == 0;
  MapParts parts = to_parts(walls, spec.um_per_cell);
  if (!spec.wall)
    parts.notes.push_back(fmt::format(
        "{}: a matrix of {} × {} cells: 0 is taken as wall, 1, {:.0f} % of them, as free; "
        "map.wall=one means the other, map.wall=zero this",
        file.string(), walls.width, walls.height,
        100.0 * static_cast<double>(ones) / static_cast<double>(walls.cells.size())));
  return parts;
}

/// Notes on what map_saver meant by 205, and on keys that were not read.
std::vector<std::string> ros_notes(const RosHeader& header, const Image& image, bool unknown_free,
                                   const std::string& name) {
  std::vector<std::string> notes;
  const SaverUnknown lost = find_saver_unknown(image, header);
  if (lost.cells > 0 && !lost.is_of_map_saver)
    notes.push_back(fmt::format(
        "{}: {} cells of grey 205, map_saver's unknown, {}are free by free_thresh {:g}; with "
        "free_thresh 0.196 they are walls",
        name, lost.lost, lost.lost > lost.cells ? "or near it " : "", header.free_thresh));
  else if (lost.cells > 0 && !unknown_free)
    notes.push_back(fmt::format(
        "{}: {} cells of grey 205, map_saver's unknown, are walls, though free_thresh {:g} would "
        "make them free; map.unknown_free=true does",
        name, lost.cells, header.free_thresh));
  if (const double yaw = header.origin[2]; std::abs(yaw) > 2 * std::numbers::pi)
    notes.push_back(
        fmt::format("{}: the yaw of origin is {:g} rad, more than a turn: ROS writes rad; if it is "
                    "{:g}°, write {:.7g}",
                    name, yaw, yaw, yaw * std::numbers::pi / 180));
  if (!header.unread.empty())
    notes.push_back(fmt::format("{}: not read: {}", name, fmt::join(header.unread, ", ")));
  return notes;
}

MapParts read(const RosMap& spec, const fs::path& base, Issues&) {
  const fs::path yaml = base / spec.file;
  const RosHeader header = read_ros_header(yaml);
  const fs::path picture = input_folder(yaml) / header.image;
  const Image image = read_image(picture);
  const auto transparent = read_transparency(picture);
  const Vec2 origin = spec.um_per_m * Vec2{header.origin[0], header.origin[1]};
  MapParts parts = to_parts(ros_walls(image, header, spec.unknown_free, transparent),
                            header.resolution * spec.um_per_m, origin);
  const double turn = map_turn(header.origin[2], norm(Vec2{1.0 * image.width, 1.0 * image.height}));
  if (turn != 0) parts = turned(std::move(parts), origin, turn);
  parts.notes = ros_notes(header, image, spec.unknown_free, yaml.string());
  return parts;
}

MapParts read(const MovingAiMap& spec, const fs::path& base, Issues&) {
  const fs::path file = base / spec.file;
  std::string unknown;
  const Mask walls = read_moving_ai(file, &unknown);
  MapParts parts = to_parts(walls, spec.um_per_cell);
  if (std::ranges::find(walls.cells, 0) == walls.cells.end())
    parts.notes.push_back(
        fmt::format("{}: all cells are walls: free are only ., G and S", file.string()));
  if (!unknown.empty())
    parts.notes.push_back(fmt::format(
        "{}: cells of {} are walls: MovingAI has ., G and S for what is free, @, O, T and W for "
        "what is not",
        file.string(), quote(unknown)));
  return parts;
}

/// Adds a note on a table of rectangles that may be meant as a matrix.
void note_matrix(const fs::path& file, std::vector<std::string>& notes) {
  if (resembles_matrix(read_file(file)))
    notes.push_back(fmt::format(
        "{}: is read as rectangles, x, y, width and height, though it looks like a matrix: "
        "map.type=matrix reads one, of 0 and 1",
        file.string()));
}

MapParts read(const GeoJsonMap& spec, const fs::path& base, Issues&) {
  return read_geojson(base / spec.file, spec.um_per_unit, spec.line_width);
}

MapParts read(const RectanglesMap& spec, const fs::path& base, Issues& issues) {
  MapParts parts;
  for (std::size_t i = 0; i < spec.rectangles.size(); ++i)
    attempt(issues, "map.rectangles_um." + std::to_string(i), [&] {
      parts.walls.push_back(
          rectangle(spec.rectangles[i], "map.rectangles_um[" + std::to_string(i) + "]"));
    });
  if (!spec.file.empty()) {
    std::vector<Polygon> more = read_rectangles(base / spec.file, spec.um_per_unit);
    std::move(more.begin(), more.end(), std::back_inserter(parts.walls));
    note_matrix(base / spec.file, parts.notes);
  }
  const Box around = enclosing_box(parts);
  parts.bounds = {spec.lo.value_or(around.lo), spec.hi.value_or(around.hi)};
  return parts;
}

MapParts read(const PolygonsMap& spec, const fs::path&, Issues& issues) {
  MapParts parts{{spec.lo, spec.hi}, {}, {}};
  for (std::size_t i = 0; i < spec.walls.size(); ++i) {
    Polygon wall = normalised({spec.walls[i], {}});
    const double area = wall.outer.empty() ? 0 : signed_area(wall.outer);
    // A wall without a finite area has coordinates that check() refuses.
    if (area == 0)
      issues.add("map.walls_um." + std::to_string(i),
                 "map.walls_um[" + std::to_string(i) +
                     "]: at least 3 points with an area between them expected");
    else if (const auto fault = std::isfinite(area) ? find_ring_fault(wall) : std::nullopt)
      parts.notes.push_back(
          fmt::format("map.walls_um[{}] crosses itself at ({:.6g}, {:.6g}) µm; all that it goes "
                      "round is a wall",
                      i, fault->at.x, fault->at.y));
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

}  // namespace

std::string* file_name(MapSpec& spec) {
  return std::visit(
      Overloaded{[](OneOf<ImageMap, RosMap, MovingAiMap, GeoJsonMap, RectanglesMap, MatrixMap,
                          SvgMap> auto& s) { return &s.file; },
                 [](OneOf<PolygonsMap, ChannelMap> auto&) -> std::string* { return nullptr; }},
      spec);
}

const std::string* file_name(const MapSpec& spec) { return file_name(const_cast<MapSpec&>(spec)); }

namespace {

bool is_from_file(const MapSpec& spec) {
  const std::string* file = file_name(spec);
  return file && !file->empty();
}

/// Key of what the map is read from.
std::string source_key(const MapSpec& spec) { return is_from_file(spec) ? "map.file" : "map"; }

/// Issues of values go into `issues`; those of a file are thrown.
MapParts read_checked(const MapSpec& spec, const fs::path& base, Issues& issues) {
  const std::string* file = file_name(spec);
  // A map type chosen by --set may have no file.
  if (file && file->empty() && !std::holds_alternative<RectanglesMap>(spec)) {
    issues.add("map.file", "missing key map.file");
    return {};
  }
  MapParts parts = std::visit([&](const auto& s) { return read(s, base, issues); }, spec);
  if (!issues.empty()) return parts;
  const std::string name = is_from_file(spec) ? (base / *file).string() : "map";
  check(parts, name);
  if (auto note = outside_note(parts, name)) parts.notes.push_back(*std::move(note));
  return parts;
}

}  // namespace

MapParts read_map_parts(const MapSpec& spec, const fs::path& base, Issues& issues) {
  Issues of_map;
  MapParts parts;
  attempt(of_map, source_key(spec), [&] { parts = read_checked(spec, base, of_map); });
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
  Issues issues;
  MapParts parts;
  try {
    parts = read_checked(spec, base, issues);
  } catch (const InputError& error) {
    for (Issue issue : error.issues()) {
      issue.keys = {source_key(spec)};
      issues.add(std::move(issue));
    }
  }
  if (!issues.empty()) throw InputError(std::move(issues));
  const std::uint64_t hash = fingerprint(parts);
  return {std::make_shared<Map>(parts.bounds, std::move(parts.walls), std::move(parts.discs)), hash,
          std::move(parts.notes)};
}

}  // namespace microswarm::formats
