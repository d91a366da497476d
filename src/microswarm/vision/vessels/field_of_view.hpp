// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"

namespace microswarm {

/// The part of the picture that the optics show: a fundus camera leaves a black surround. Where the
/// dark rim that touches the border does not enclose one nearly convex bright piece, there is no
/// surround, and the whole picture is the field of view.
Mask field_of_view(const Image& image);

}  // namespace microswarm
