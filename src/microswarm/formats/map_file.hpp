// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "microswarm/core/fields.hpp"
#include "microswarm/core/places.hpp"
#include "microswarm/formats/map_parts.hpp"
#include "microswarm/formats/map_spec.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Reads what the spec names, files relative to the folder `base`. Throws InputError, one line that
/// names file, place, value and limit; `where` knows the key `map` of a scenario.
MapParts read_map_parts(const MapSpec& spec, const std::filesystem::path& base = {},
                        const Places& where = {});

/// A map ready for planning, and the fingerprint of the parts it was built from.
struct LoadedMap {
  std::shared_ptr<const Map> map;
  std::uint64_t input_hash = 0;
};

/// Reads and builds. Throws InputError.
LoadedMap load_map(const MapSpec& spec, const std::filesystem::path& base = {});

/// The spec for a file on the command line, by its extension and content: a picture, a ROS YAML, a
/// MovingAI .map, GeoJSON (.geojson, .json) or rectangles (.csv, .txt). `um_per_px` is the side of
/// a pixel or cell; a picture needs it: "x.png: µm per px is missing: give --um-per-px". Throws
/// InputError for what is none of these.
MapSpec guess_map_spec(const std::filesystem::path& path,
                       std::optional<double> um_per_px = std::nullopt);

}  // namespace microswarm
