// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// A square of 10 µm with a square hole of 6 µm in its middle.
inline const Polygon frame{{{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                           {{{2, 2}, {2, 8}, {8, 8}, {8, 2}}}};

}  // namespace microswarm
