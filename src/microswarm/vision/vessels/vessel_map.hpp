// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/vision/vessels/vessels.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::vision {

/// Map of segmented vessels, which are free; the lower left corner of the picture is at 0.
/// `um_per_px` is the side of a pixel, 1e-6 to 1e6, `smooth` the tolerance of the outlines [px], 0
/// to 100. `name` stands for the picture in messages. Throws InputError for values out of range,
/// and "NAME: no vessels found". `stop` ends it with a map of nothing.
Map vessel_map(const VesselSegmentation& found, double um_per_px, double smooth,
               const std::string& name, const Stop& stop = {});

}  // namespace microswarm::vision
