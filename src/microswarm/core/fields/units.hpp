// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace microswarm {

/// Unit of a parameter or a recorded quantity. Internally lengths are µm, times s, angles rad, flux
/// densities mT and currents A; `deg` marks an angle stored in rad and displayed in degrees.
enum class Unit {
  none,
  um,
  s,
  hz,
  rad,
  deg,
  um_per_s,
  deg_per_s,
  per_s,
  um2,
  px,
  um_per_px,
  ms,
  mt,
  mt_per_a,
  t_per_m,
  t_per_m_per_a,
  a,
  a_per_s,
  v,
  ohm,
  mh,
  degc,
  k_per_w,
  per_k
};

/// Suffix of a key or column in this unit: "um" in `step_um`; empty for `none`.
std::string_view unit_suffix(Unit unit);

/// Displayed symbol: "µm", "µm/s", "°"; empty for `none`.
std::string_view unit_symbol(Unit unit);

/// Factor from the stored to the displayed value: 180/π for `deg` and `deg_per_s`, else 1.
double unit_shown_per_stored(Unit unit);

}  // namespace microswarm
