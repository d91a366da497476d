// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "microswarm/config/settings.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/map_spec.hpp"

namespace microswarm::formats {

/// Formats of the files that guess_map_spec takes, in words: "picture, …".
std::string map_formats();

/// Choices of a caller about a map file.
struct MapChoice {
  std::optional<double> um_per_px{};    ///< side of a pixel or cell [µm]
  std::optional<double> um_per_unit{};  ///< µm for a unit of a file in plane coordinates
  Settings settings{};                  ///< of keys within `map`, such as map.free=dark
};

/// The map of a MapChoice as its settings see it.
struct MapKey {
  MapSpec map{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.map, plain("map", "How the map file is read."));
  }
};

/// Whether a setting is of a key within `map`.
bool is_of_map(const Setting& setting);

/// Spec of a map file: of the type that the settings choose, else from its extension and content. A
/// picture needs the side of a pixel: "x.png: µm per px is missing: give um_per_px". Throws
/// InputError for other files, and for a scale that the kind of map does not have.
MapSpec choose_map_spec(const std::filesystem::path& path, const MapChoice& choice);

/// The same without settings.
MapSpec guess_map_spec(const std::filesystem::path& path,
                       std::optional<double> um_per_px = std::nullopt);

}  // namespace microswarm::formats
