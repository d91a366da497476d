// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/rig/watch/picture_registration.hpp"

namespace microswarm::rig {

/// Result of the comparison of a scenario's map with a picture, before the first current.
struct MapCheck {
  bool good = true;    ///< false: the picture is displaced beyond the rig's limit
  bool sure = true;    ///< false: it is not known, or there is no limit
  std::string text{};  ///< one line
};

/// Judges a fit by `safety.max_map_shift_px`, 0 for no limit; the line has the scale that would
/// fit.
MapCheck check_map(const PictureFit& fit, double max_shift_px);

}  // namespace microswarm::rig
