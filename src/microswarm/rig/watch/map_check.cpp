// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/map_check.hpp"

#include <fmt/format.h>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::rig {

MapCheck check_map(const PictureFit& fit, double limit) {
  if (!fit.unsure.empty())
    return {true, false, "it is not known whether the map lies over the picture: " + fit.unsure};
  if (limit <= 0)
    return {true, false, fit_text(fit) + "; safety.max_map_shift_px is 0: there is no limit"};
  if (fit.shift_px <= limit) return {true, true, fit_text(fit)};
  const vision::CameraScale& scale = fit.scale;
  return {false, true,
          fmt::format("{}; safety.max_map_shift_px is {:.6g}. `scale: {{um_per_px: {:.6g}, "
                      "rotation_deg: {:.4g}, y_up: {}, origin_px: [{:.1f}, {:.1f}]}}` would fit: "
                      "measure it with `microswarm rig scale`, or correct the map",
                      fit_text(fit), limit, scale.um_per_px, degrees(scale.rotation), scale.y_up,
                      scale.origin_px.x, scale.origin_px.y)};
}

}  // namespace microswarm::rig
