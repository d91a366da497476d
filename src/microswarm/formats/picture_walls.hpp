// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/formats/map_spec.hpp"

namespace microswarm::formats {

/// Walls of a picture: what is not free at this grey level. Throws InputError "NAME: WHY", with
/// advice, if all of it is wall.
Mask picture_walls(const Image& image, int level, FreePixels free, const std::string& name);

/// Note on a picture without walls.
std::string no_walls_note(int level, FreePixels free, const std::string& name);

}  // namespace microswarm::formats
