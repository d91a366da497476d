// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "microswarm/formats/images/mask.hpp"

namespace microswarm::formats {

/// Whether the text is meant as a matrix: more than half of its rows consist of the numbers 0 and
/// 1, at least two in a row. Where they are four long, as those of rectangles, all rows must be.
bool is_matrix(std::string_view text);

/// Reads a matrix of 0 and 1, the upper row first: between blanks, tabs, commas or semicolons
/// (also as 1.0 or 1e0, or in double quotes), or digits side by side. Blank lines and lines that
/// start with '#', '%' or
/// "//" are skipped. The mask's set cells are the ones. Throws InputError "NAME:LINE: WHY".
Mask parse_matrix(std::string_view text, std::string_view name);
Mask read_matrix(const std::filesystem::path& path);

/// Whether a table of whole numbers may be a matrix though it is none of 0 and 1 only: most of its
/// rows are, or it holds only two numbers, such as 0 and 255.
bool resembles_matrix(std::string_view text);

/// Whether the file holds a matrix; false if it cannot be read. Throws InputError for UTF-16.
bool is_matrix_file(const std::filesystem::path& path);

}  // namespace microswarm::formats
