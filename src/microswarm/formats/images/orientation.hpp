// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "microswarm/formats/images/deep_image.hpp"

namespace microswarm::formats {

/// Orientation, 1 to 8, in a JPEG or a block of EXIF: which side of the stored picture is up. 1, as
/// it is shown, without one.
int exif_orientation(std::span<const std::byte> jpeg_or_exif);

/// Turns a stored picture as its orientation says it is to be shown. EXIF and TIFF number alike: 2
/// to 4 mirror, 5 to 8 transpose as well. Other numbers change nothing.
void orient(DecodedImage& picture, int orientation);

}  // namespace microswarm::formats
