// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "lab/files/uploads.hpp"
#include "lab/stream/request.hpp"

namespace microswarm::lab {

/// Vessels found in a photograph.
struct FoundVessels {
  std::string png;   ///< the photograph with their outline
  std::string json;  ///< method and polarity, share of the view, pieces, kept share, widths [px]
};

/// JSON Schema of the search's parameters.
std::string vessel_schema();

/// A photograph of any format as JPEG. Throws InputError.
std::string to_jpeg(const std::filesystem::path& photograph);

/// Searches the photograph. Throws InputError for a wrong setting.
FoundVessels find_vessels(const std::filesystem::path& photograph, const PhotoRequest& request);

/// Makes an experiment in the vessels of a photograph: a swarm that moves from start to goal, or
/// robots that gather at the goal, with sizes and speeds scaled to the vessels' width. Start and
/// goal move to the nearest free position. Returns the scenario's file; it and its map are uploads.
/// Throws InputError if no vessels are found or a point is outside of them.
std::filesystem::path make_photo_scenario(const std::filesystem::path& photograph,
                                          const PhotoRequest& request, Uploads& uploads);

}  // namespace microswarm::lab
