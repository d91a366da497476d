// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {

/// Reads a Netpbm image P1 to P6 (PBM, PGM, PPM, plain or raw; maximum up to 65535, scaled to 8
/// bits). Throws InputError "NAME: WHY".
Image decode_pnm(std::span<const std::byte> bytes, std::string_view name);

/// Raw PGM (grey) or PPM (colour) of an 8-bit image.
std::string encode_pnm(const Image& image);

}  // namespace microswarm::formats
