// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lab/files/uploads.hpp"
#include "lab/stream/request.hpp"
#include "microswarm/vision/vessels/vessels.hpp"

namespace microswarm::lab {

/// Vessels found in a photograph.
struct FoundVessels {
  /// The photograph with their outline; those that are wide enough for a swarm are tinted.
  std::string png;
  std::string json;  ///< method and polarity, shares, pieces, widths [px]
};

/// JSON Schema of the search's parameters.
std::string vessel_schema();

/// A photograph of any format as JPEG. Throws InputError.
std::string to_jpeg(const std::filesystem::path& photograph);

/// Searches photographs for vessels and makes experiments in them. It keeps the last result, so
/// that an experiment is made in what was just found. Used by one thread.
class VesselSearch {
 public:
  /// Throws InputError for a wrong setting.
  FoundVessels find(const std::filesystem::path& photograph, const PhotoRequest& request);

  /// Makes an experiment in the vessels of a photograph: a swarm that moves from start to goal, or
  /// robots that gather at the goal, with sizes and speeds scaled to the vessels' width. Start and
  /// goal move to the nearest free position. Returns the scenario's file; it and its map are
  /// uploads. Throws InputError if no vessels are found or a point is outside of them.
  std::filesystem::path make_scenario(const std::filesystem::path& photograph,
                                      const PhotoRequest& request, Uploads& uploads);

 private:
  struct Result {
    std::filesystem::path photograph;
    std::filesystem::file_time_type written;
    std::vector<std::string> settings;
    vision::VesselSegmentation found;
  };
  const vision::VesselSegmentation& search(const std::filesystem::path& photograph,
                                           const PhotoRequest& request);

  std::optional<Result> last_;
};

}  // namespace microswarm::lab
