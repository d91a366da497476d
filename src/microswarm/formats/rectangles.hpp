// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm::formats {

/// Reads rectangles, one per line: lower left x, y, width, height, in units of `um_per_unit` [µm],
/// separated by commas, semicolons or blanks, the numbers with a decimal point, or between
/// semicolons with a decimal comma. A first line without numbers is a header. Blank lines and lines
/// that start with '#' are skipped. Throws InputError "NAME:LINE: WHY".
std::vector<Polygon> read_rectangles(const std::filesystem::path& path, double um_per_unit = 1);
std::vector<Polygon> parse_rectangles(std::string_view text, std::string_view name,
                                      double um_per_unit = 1);

/// Polygon of a rectangle x, y, width, height [µm]. Throws InputError "WHERE: WHY" unless there are
/// four numbers, the last two above 0.
Polygon rectangle(std::span<const double> numbers, const std::string& where);

}  // namespace microswarm::formats
