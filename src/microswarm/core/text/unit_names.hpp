// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace microswarm {

/// Size of a unit of length [µm] by the names that ImageJ, OME and TrackMate write: "µm", "micron",
/// "nm" and others; nothing for any other name, such as "pixel", and for "inch", which stands for
/// the resolution of a screen.
std::optional<double> length_unit_um(std::string_view name);

/// Size of a unit of time [s]: "s", "sec", "ms", "min" and others; nothing for any other name.
std::optional<double> time_unit_s(std::string_view name);

}  // namespace microswarm
