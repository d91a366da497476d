// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"

namespace microswarm::vision {

/// The picture in colour with the outline of the mask drawn just outside the mask. The line is
/// thick enough to show when the whole picture is scaled to a screen. Throws InputError if the
/// sizes differ.
formats::Image overlay(const formats::Image& picture, const formats::Mask& mask,
                       std::array<std::uint8_t, 3> rgb = {0, 255, 255});

}  // namespace microswarm::vision
