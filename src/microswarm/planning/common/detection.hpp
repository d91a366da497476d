// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/plan.hpp"

namespace microswarm {

/// Eq 1–3 [drrt] for one detection circle, the factor floored at `rho_min`. A circle of radius 0
/// sees nothing.
Detection detect(const Snapshot& world, Disc circle, double rho_min);

}  // namespace microswarm
