// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace microswarm::actuation {

/// Conversion from SI files (m and T) to internal units (µm and mT).
inline constexpr double um_per_m = 1e6;
inline constexpr double mt_per_t = 1e3;

}  // namespace microswarm::actuation
