// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/vision/scene/blobs.hpp"

namespace microswarm::vision {

/// Settings of `find_swarm`.
struct SwarmFinderParams {
  BlobParams look{};
  double jump = 60;
  double rival = 0.3;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.look, plain("look", "Appearance of the swarm."));
    visit(self.jump, px("jump", 0, 1e5, "Maximum displacement between two frames."));
    visit(self.rival, plain("rival", 0, 1, "Relative area from which a second blob is a rival."));
  }
};

/// Result of the search for one swarm.
enum class SwarmSight {
  found,    ///< exactly one candidate
  none,     ///< no candidate
  far,      ///< no candidate within `jump` of the last position
  several,  ///< several candidates that cannot be distinguished
};
constexpr auto enum_names(SwarmSight) {
  return std::array<std::pair<SwarmSight, std::string_view>, 4>{{{SwarmSight::found, "found"},
                                                                 {SwarmSight::none, "none"},
                                                                 {SwarmSight::far, "far"},
                                                                 {SwarmSight::several, "several"}}};
}

/// The swarm in a picture.
struct SwarmSighting {
  SwarmSight sight = SwarmSight::none;
  std::optional<Blob> swarm{};     ///< set if found
  std::vector<Blob> candidates{};  ///< all candidates, sorted by decreasing area
  std::vector<Blob> others{};      ///< too far, or too small beside the largest candidate
};

/// Chooses the swarm among blobs sorted by decreasing area; `before_px` as in `find_swarm`.
SwarmSighting choose_swarm(std::vector<Blob> blobs, const SwarmFinderParams& params,
                           std::optional<Vec2> before_px);

/// Searches a microscope picture for one swarm: a cloud of particles or clumps. With `before_px`,
/// its last known position, only blobs within `jump` of it are candidates. `walls`, pictures and
/// errors as in `find_blobs`.
SwarmSighting find_swarm(const formats::Image& picture, const SwarmFinderParams& params = {},
                         std::optional<Vec2> before_px = std::nullopt,
                         const formats::Mask* walls = nullptr);

}  // namespace microswarm::vision
