// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "microswarm/formats/map_parts.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// The map's bounds and wall pieces, as they are after overlapping walls were united.
MapParts parts_of(const Map& map);

/// Writes a map in the form that the extension names, by way of temporary files: .geojson or .json
/// (exact polygons and discs), or in square cells of `cell` [µm] with what is not free at a cell's
/// centre as walls: .png (walls black, free white), .map (MovingAI), .yaml (ROS, with a .pgm beside
/// it; 1 m = 1e6 µm). Throws InputError for another extension, a `cell` that is missing (0) or
/// gives too many cells, and "PATH: cannot write: REASON".
void write_map(const std::filesystem::path& path, const Map& map, double cell = 0);

}  // namespace microswarm
