// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/fields/units.hpp"

#include <cassert>
#include <numbers>

namespace microswarm {
namespace {

constexpr double shown_degrees = 180 / std::numbers::pi;

struct UnitText {
  std::string_view suffix;
  std::string_view symbol;
  double shown_per_stored = 1;
};

UnitText unit_text(Unit unit) {
  switch (unit) {
    case Unit::none:
      return {"", ""};
    case Unit::um:
      return {"um", "µm"};
    case Unit::s:
      return {"s", "s"};
    case Unit::hz:
      return {"hz", "Hz"};
    case Unit::rad:
      return {"rad", "rad"};
    case Unit::deg:
      return {"deg", "°", shown_degrees};
    case Unit::um_per_s:
      return {"um_per_s", "µm/s"};
    case Unit::deg_per_s:
      return {"deg_per_s", "°/s", shown_degrees};
    case Unit::per_s:
      return {"per_s", "1/s"};
    case Unit::um2:
      return {"um2", "µm²"};
    case Unit::px:
      return {"px", "px"};
    case Unit::um_per_px:
      return {"um_per_px", "µm/px"};
    case Unit::ms:
      return {"ms", "ms"};
    case Unit::mt:
      return {"mt", "mT"};
    case Unit::mt_per_a:
      return {"mt_per_a", "mT/A"};
    case Unit::t_per_m:
      return {"t_per_m", "T/m"};
    case Unit::t_per_m_per_a:
      return {"t_per_m_per_a", "T/m/A"};
    case Unit::a:
      return {"a", "A"};
    case Unit::a_per_s:
      return {"a_per_s", "A/s"};
    case Unit::v:
      return {"v", "V"};
    case Unit::ohm:
      return {"ohm", "Ω"};
    case Unit::mh:
      return {"mh", "mH"};
    case Unit::degc:
      return {"degc", "°C"};
    case Unit::k_per_w:
      return {"k_per_w", "K/W"};
    case Unit::per_k:
      return {"per_k", "1/K"};
  }
  assert(false);
  return {};
}

}  // namespace

std::string_view unit_suffix(Unit unit) { return unit_text(unit).suffix; }
std::string_view unit_symbol(Unit unit) { return unit_text(unit).symbol; }
double unit_shown_per_stored(Unit unit) { return unit_text(unit).shown_per_stored; }

}  // namespace microswarm
