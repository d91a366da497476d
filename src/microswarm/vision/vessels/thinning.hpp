// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/formats/images/mask.hpp"

namespace microswarm::vision {

/// Thins the set cells to lines one cell wide (8-connected) with as many pieces and holes: simple
/// cells are removed one by one, from four sides in turn, and ends of lines are kept. Cells beyond
/// the mask are unset. `stop` leaves thicker lines.
void thin(formats::Mask& mask, const Stop& stop = {});

/// Which of the eight neighbours of an inner or border cell are set: bit k for the k-th,
/// anticlockwise from the right as the picture is shown.
unsigned set_neighbours(const formats::Mask& mask, int column, int row);

/// Steps to the eight neighbours, in that order.
inline constexpr int neighbour_columns[8] = {1, 1, 0, -1, -1, -1, 0, 1};
inline constexpr int neighbour_rows[8] = {0, -1, -1, -1, 0, 1, 1, 1};

}  // namespace microswarm::vision
