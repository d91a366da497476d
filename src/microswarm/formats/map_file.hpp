// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/formats/map_parts.hpp"
#include "microswarm/formats/map_spec.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::formats {

/// Reads the map given by `spec`; file names are relative to the folder `base`. Mistakes go into
/// `issues` with the keys of a scenario; one in a file is about the file's key and begins with its
/// name. If there are issues, the parts must not be used.
MapParts read_map_parts(const MapSpec& spec, const std::filesystem::path& base, Issues& issues);
/// The same, but throws InputError with a line for each issue.
MapParts read_map_parts(const MapSpec& spec, const std::filesystem::path& base = {},
                        const KeyLocations& keys = {});

/// A map ready for planning, and the fingerprint of its parts.
struct LoadedMap {
  std::shared_ptr<const Map> map{};
  std::uint64_t input_hash = 0;
  std::vector<std::string> notes{};  ///< what was assumed or left out, one line each
};

/// Reads and builds a map. Throws InputError; what is wrong with a file has its place there.
LoadedMap load_map(const MapSpec& spec, const std::filesystem::path& base = {});

/// File of the map; null if its kind has none.
std::string* file_name(MapSpec& spec);
const std::string* file_name(const MapSpec& spec);

}  // namespace microswarm::formats
