// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/coil_notes.hpp"

#include <fmt/format.h>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/text/lines.hpp"

namespace microswarm::rig {

std::vector<std::string> CoilNotes::take(const actuation::CoilOutput& output,
                                         const actuation::CoilSystem& system) {
  constexpr double margin = 0.5;  // [K], of the model's rounding
  std::vector<std::string> notes;
  std::string broken;
  for (const std::string_view trouble : split(output.probe_trouble, ','))
    if (!trouble.empty() && said_.emplace(trouble).second)
      broken += fmt::format("{}{}", broken.empty() ? "" : ", ", trouble);
  if (!broken.empty())
    notes.push_back(broken + ": by its model alone that coil may be warmer than known");
  for (Eigen::Index k = 0; k < output.temperatures.size(); ++k) {
    const auto coil = static_cast<std::size_t>(k);
    const double limit = system.amplifiers()[coil].max_temperature.value_or(infinity);
    const std::string& name = system.coil_names()[coil];
    if (output.temperatures[k] > limit + margin && said_.insert("coil " + name).second)
      notes.push_back(fmt::format("coil {} is at {:.6g} °C by its probe, limit {:.6g} °C", name,
                                  output.temperatures[k], limit));
  }
  return notes;
}

}  // namespace microswarm::rig
