// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "microswarm/formats/map_parts.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::formats {

/// The map's bounds and wall pieces, after overlapping walls were united.
MapParts to_parts(const Map& map);

/// Formats of write_map, in words.
inline constexpr std::string_view written_map_formats =
    ".geojson, .png, .map (MovingAI) or .yaml (ROS)";

/// Writes a map in the format given by the extension, through temporary files. .geojson and .json
/// hold exact polygons and discs. The others hold square cells of `cell` [µm], with walls where a
/// cell's centre is not free: .png (walls black, free white), .map (MovingAI), .yaml (ROS, with a
/// .pgm beside it; 1 m = 1e6 µm). Throws InputError for another extension, a `cell` that is missing
/// (0) or gives too many cells, and "PATH: cannot write: REASON".
void write_map(const std::filesystem::path& path, const Map& map, double cell = 0);

}  // namespace microswarm::formats
