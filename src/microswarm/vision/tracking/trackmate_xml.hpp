// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "microswarm/vision/tracking/track_table.hpp"

namespace microswarm::vision {

/// Reads XML of TrackMate: what it saves (`TrackMate`: visible spots and the tracks that passed its
/// filters, scale, interval and height of the pictures) or its export of tracks (`Tracks`). Rows
/// are sorted by frame. Positions of the export in a unit of length
/// need `um_per_px`. A unit that is neither a length nor the pixel is refused. Throws InputError
/// "NAME:LINE: WHY".
TrackTable parse_trackmate_xml(std::string_view text, std::string_view name,
                               std::optional<double> um_per_px);

}  // namespace microswarm::vision
