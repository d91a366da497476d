// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/formats/images/tiff_description.hpp"

namespace microswarm::formats {

/// Whether a page's description is OME's XML, with or without a prefix of its namespace.
bool is_ome(std::string_view text);

/// Reads OME's description of the file named `file_name`: its first image. What cannot be used is
/// named in `notes`. Throws nothing. Source: OME-TIFF specification, 2016-06.
TiffDescription parse_ome(std::string_view text, std::string_view file_name);

}  // namespace microswarm::formats
