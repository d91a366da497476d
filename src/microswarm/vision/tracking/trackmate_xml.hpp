// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "microswarm/vision/tracking/track_table.hpp"

namespace microswarm::vision {

/// Reads XML of TrackMate: what it saves (`TrackMate`: visible spots and the tracks that passed its
/// filters, scale, interval and height of the pictures) or its export of tracks (`Tracks`). Rows
/// are sorted by frame. Units of length other than µm, nm, … are taken as px. Positions of the
/// export are in px only with `um_per_px`, unless their unit is no length. Throws InputError
/// "NAME:LINE: WHY".
TrackTable parse_trackmate_xml(std::string_view text, std::string_view name,
                               std::optional<double> um_per_px);

}  // namespace microswarm::vision
