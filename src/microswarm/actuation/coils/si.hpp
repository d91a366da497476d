// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace microswarm {

/// Files that are in SI units hold m and T; µm and mT are what is used inside.
inline constexpr double um_per_m = 1e6;
inline constexpr double mt_per_t = 1e3;

}  // namespace microswarm
