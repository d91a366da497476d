// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/map_parts.hpp"
#include "microswarm/formats/map_spec.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::formats {

/// Reads the map given by `spec`; file names are relative to the folder `base`. Mistakes go into
/// `issues` with the keys of a scenario; a mistake in a file has no key and begins with the file's
/// name. If there are issues, the parts must not be used.
MapParts read_map_parts(const MapSpec& spec, const std::filesystem::path& base, Issues& issues);
/// The same, but throws InputError with a line for each issue.
MapParts read_map_parts(const MapSpec& spec, const std::filesystem::path& base = {},
                        const KeyLocations& keys = {});

/// A map ready for planning, and the fingerprint of its parts.
struct LoadedMap {
  std::shared_ptr<const Map> map;
  std::uint64_t input_hash = 0;
};

/// Reads and builds a map. Throws InputError.
LoadedMap load_map(const MapSpec& spec, const std::filesystem::path& base = {});

/// File of the map; null if its kind has none.
std::string* file_name(MapSpec& spec);
const std::string* file_name(const MapSpec& spec);

/// Formats of the files that guess_map_spec takes, in words: "picture, …".
std::string map_formats();

/// Spec of a map file, from its extension and content. `um_per_px`, which the caller calls
/// `option`, is the side of a pixel or cell; an image needs it: "x.png: µm per px is missing: give
/// --um-per-px". Throws InputError for other files.
MapSpec guess_map_spec(const std::filesystem::path& path,
                       std::optional<double> um_per_px = std::nullopt,
                       std::string_view option = "--um-per-px");

}  // namespace microswarm::formats
