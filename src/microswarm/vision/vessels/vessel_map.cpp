// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/vessel_map.hpp"

#include <string>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/vision/vessels/outline.hpp"

namespace microswarm::vision {

Map vessel_map(const VesselSegmentation& found, double um_per_px, double smooth,
               const std::string& name, const Stop& stop) {
  if (!(um_per_px >= 1e-6 && um_per_px <= 1e6))
    throw InputError(name, "um_per_px is " + number_text(um_per_px) + ", must be 1e-6 to 1e6");
  if (!(smooth >= 0 && smooth <= 100))
    throw InputError(name, "smooth_px is " + number_text(smooth) + ", must be 0 to 100");
  if (found.kept_share == 0) {
    const std::string faint = note_on_noise(found);
    throw InputError(name, "no vessels found" + (faint.empty() ? "" : ": " + faint));
  }
  auto walls = walls_around(found.vessels, um_per_px, smooth * um_per_px, {}, stop);
  if (stop()) return {};
  return Map(formats::cell_bounds(found.vessels, um_per_px), std::move(walls));
}

}  // namespace microswarm::vision
