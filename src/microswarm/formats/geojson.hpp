// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "microswarm/formats/map_parts.hpp"

namespace microswarm::formats {

/// Reads a GeoJSON text (RFC 7946, in plane coordinates, y up): a FeatureCollection, Feature or
/// geometry. Polygon and MultiPolygon are walls with holes; Point and MultiPoint with a property
/// `radius` are discs; LineString and MultiLineString are walls of the property `width`, or of
/// `line_width` [µm] if that is above 0, with round ends. The map's bounds are the rectangle of the
/// feature with the property `bounds: true`, else the member `bbox`, else the bounding box of
/// everything. Coordinates, radii and widths are multiplied by `um_per_unit`; without it by the
/// file's member `um_per_unit`, else by 1, with a note if they look like degrees or metres. A hole
/// outside or across its ring, and a `crs` without `um_per_unit`, are refused; a ring that crosses
/// itself is noted. Throws InputError with line and position: "x.geojson:7:
/// features[3].geometry.coordinates[0][2]: WHY".
MapParts read_geojson(const std::filesystem::path& path,
                      std::optional<double> um_per_unit = std::nullopt, double line_width = 0);
MapParts parse_geojson(std::string_view text, std::string_view name,
                       std::optional<double> um_per_unit = std::nullopt, double line_width = 0);

/// GeoJSON text in µm, which reads back to the same bits.
std::string geojson_text(const MapParts& parts);

}  // namespace microswarm::formats
