// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "calls.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"

namespace microswarm::python {

/// Copies a contiguous array of uint8 or uint16 of shape (height, width) or (height, width, 3) into
/// an image. 16-bit numbers have `depth` bits; without a value it is set to what this picture
/// needs. Throws InputError.
void take_array(const py::array& array, std::optional<int>& depth, std::string_view name,
                formats::Image& image);

/// Array of booleans of shape (height, width) from a mask.
py::array_t<bool> to_array(const formats::Mask& mask);

}  // namespace microswarm::python
