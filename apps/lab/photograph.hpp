// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "lab/request.hpp"
#include "lab/uploads.hpp"

namespace microswarm::lab {

/// The vessels that were found in a photograph.
struct FoundVessels {
  std::string png;   ///< the photograph with their outline
  std::string json;  ///< share of the view, pieces, kept share, widths [px]
};

/// JSON Schema of the search's parameters.
std::string vessel_schema();

/// A photograph as JPEG, whatever its format. Throws InputError.
std::string jpeg_of(const std::filesystem::path& photograph);

/// Searches the photograph. Throws InputError for a wrong setting.
FoundVessels find_vessels(const std::filesystem::path& photograph, const PhotoRequest& request);

/// Makes an experiment in the vessels of a photograph, a swarm that goes from start to goal or
/// robots that gather at the goal, whose sizes and speeds suit the vessels' width. Start and goal
/// move to the nearest free place. Returns the scenario's file, among the uploads, as is its map.
/// Throws InputError if no vessels are found or a place is not in them.
std::filesystem::path make_photo_scenario(const std::filesystem::path& photograph,
                                          const PhotoRequest& request, Uploads& uploads);

}  // namespace microswarm::lab
