// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/core/fields.hpp"
#include "microswarm/formats/map_parts.hpp"
#include "microswarm/formats/map_spec.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Reads what the spec names, files relative to the folder `base`. What is wrong goes into
/// `issues`, with the keys of a scenario; what is wrong in a file has no key and begins with the
/// file's name. Then the parts are of no use.
MapParts read_map_parts(const MapSpec& spec, const std::filesystem::path& base, Issues& issues);
/// The same; throws InputError with a line for each issue.
MapParts read_map_parts(const MapSpec& spec, const std::filesystem::path& base = {},
                        const KeyLocations& keys = {});

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
