// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "microswarm/formats/map_parts.hpp"

namespace microswarm::formats {

/// Reads a GeoJSON text (RFC 7946, in plane coordinates, y up): a FeatureCollection, Feature or
/// geometry. Polygon and MultiPolygon are walls with holes; Point and MultiPoint with a property
/// `radius` are discs. The map's bounds are the rectangle of the feature with the property `bounds:
/// true`, else the member `bbox`, else the bounding box of everything. Coordinates and radii are
/// multiplied by `um_per_unit`. Throws InputError with line and position: "x.geojson:7:
/// features[3].geometry.coordinates[0][2]: WHY".
MapParts read_geojson(const std::filesystem::path& path, double um_per_unit = 1);
MapParts parse_geojson(std::string_view text, std::string_view name, double um_per_unit = 1);

/// GeoJSON text in µm, which reads back to the same bits.
std::string geojson_text(const MapParts& parts);

}  // namespace microswarm::formats
