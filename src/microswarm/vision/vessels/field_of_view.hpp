// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"

namespace microswarm::vision {

/// The part of the picture inside the optical field of view; a fundus camera leaves a black
/// surround. If the dark rim along the border, with three corners of the picture, does not enclose
/// one nearly convex bright piece, the field of view is the whole picture.
formats::Mask field_of_view(const formats::Image& image);

}  // namespace microswarm::vision
