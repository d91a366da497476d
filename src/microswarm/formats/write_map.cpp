// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/write_map.hpp"

#include <fmt/format.h>

#include <variant>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/geojson.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/pnm.hpp"
#include "microswarm/formats/images/rasterise.hpp"
#include "microswarm/formats/moving_ai.hpp"
#include "microswarm/formats/ros.hpp"

namespace microswarm::formats {
namespace {

constexpr double um_per_m = 1e6;

Image picture(const Mask& walls, std::uint8_t free_grey) {
  Image image{walls.width, walls.height, 1, {}};
  for (const std::uint8_t cell : walls.cells) image.pixels.push_back(cell ? 0 : free_grey);
  return image;
}

void write_ros(const std::filesystem::path& yaml, const Mask& walls, double cell, Vec2 origin) {
  constexpr std::uint8_t free_grey = 254;  // as written by map_saver
  std::filesystem::path pgm = yaml;
  pgm.replace_extension(".pgm");
  RosHeader header;
  header.image = pgm.filename().string();
  header.resolution = cell / um_per_m;
  header.origin = {origin.x / um_per_m, origin.y / um_per_m, 0};
  write_file_atomically(pgm, encode_pnm(picture(walls, free_grey)));
  write_file_atomically(yaml, ros_header_text(header));
}

}  // namespace

MapParts to_parts(const Map& map) {
  MapParts parts{map.bounds(), {}, {}};
  for (const Body& body : map.walls().bodies())
    std::visit(Overloaded{[&](const Disc& disc) { parts.discs.push_back(disc); },
                          [&](const Polygon& polygon) { parts.walls.push_back(polygon); }},
               body.shape);
  return parts;
}

void write_map(const std::filesystem::path& path, const Map& map, double cell) {
  const std::string extension = path.extension().string();
  if (extension == ".geojson" || extension == ".json")
    return write_file_atomically(path, geojson_text(to_parts(map)));
  if (extension != ".png" && extension != ".map" && extension != ".yaml")
    throw InputError(path.string(), fmt::format("maps are written as {}", written_map_formats));
  if (cell == 0)
    throw InputError(path.string(), "the size of a cell is missing: give " + input_name("cell"));
  const Mask walls = rasterise(map, cell);
  if (extension == ".png")
    write_png(path, picture(walls, 255));
  else if (extension == ".map")
    write_file_atomically(path, moving_ai_text(walls));
  else
    write_ros(path, walls, cell, map.bounds().lo);
}

}  // namespace microswarm::formats
