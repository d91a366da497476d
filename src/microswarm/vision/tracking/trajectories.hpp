// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/tracking/video_tracker.hpp"

namespace microswarm::vision {

/// Colour picture of all trajectories over a paler `picture`, with a scale bar: a line for each
/// robot, a filled dot where it begins and a ring where it ends. Positions that a robot was not
/// seen between are joined by a thinner line. `rows` are sorted by frame.
formats::Image draw_trajectories(const formats::Image& picture, std::span<const TrackRow> rows,
                                 double um_per_px);

}  // namespace microswarm::vision
