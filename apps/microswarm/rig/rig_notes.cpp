// SPDX-License-Identifier: Apache-2.0
#include "rig/rig_notes.hpp"

#include <fmt/core.h>

#include "support/cli.hpp"

namespace microswarm::cli {

void note_field(const Rig& rig, const Scenario& scenario) {
  const std::string unusual = unusual_field(rig, scenario);
  if (!unusual.empty()) note("note: {}: {}\n", name_of(rig), unusual);
}

std::string quantiles(const Durations& times) {
  if (times.count() == 0) return "–";
  return fmt::format("{:.2f} / {:.2f} / {:.2f} ms", 1e3 * times.quantile(0.5),
                     1e3 * times.quantile(0.95), 1e3 * times.quantile(0.99));
}

}  // namespace microswarm::cli
