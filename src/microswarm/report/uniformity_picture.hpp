// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "microswarm/actuation/coils/uniformity.hpp"

namespace microswarm::report {

/// Draws the deviation of the field in six colours; the highest row is on top. The title names the
/// plane, the field at the centre and, with `centre`, its position. The file's extension selects
/// the format: .png, .svg or .pdf.
void draw_uniformity(const actuation::UniformityMap& map, bool centre,
                     const std::filesystem::path& file);

/// The map as CSV: position, field and deviation of each point.
std::string uniformity_table(const actuation::UniformityMap& map);

}  // namespace microswarm::report
