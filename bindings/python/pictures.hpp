// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "calls.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"

namespace microswarm::python {

/// Takes an array of uint8 or uint16, contiguous, of the shape (height, width) or (height, width,
/// 3). 16-bit numbers have `depth` bits, by default as many as this picture needs, which `depth`
/// then keeps. Throws InputError.
void take_array(const py::array& array, std::optional<int>& depth, std::string_view name,
                Image& image);

/// An array of booleans of the shape (height, width).
py::array_t<bool> array_of(const Mask& mask);

}  // namespace microswarm::python
