// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/latency_rows.hpp"

#include <fmt/format.h>

namespace microswarm::report {

void add_latency_rows(std::vector<std::vector<std::string>>& table,
                      const experiment::Record& record) {
  const auto& latency = record.rig_log.latency;
  if (!latency) return;
  table.push_back({"camera to current: median, p99, longest",
                   fmt::format("{:.1f}, {:.1f}, {:.1f} ms", 1e3 * latency->median,
                               1e3 * latency->p99, 1e3 * latency->longest)});
  table.push_back({"pictures with currents more than a tick later",
                   fmt::format("{} of {}", latency->late_currents, latency->pictures)});
  table.push_back({"missed deadlines",
                   fmt::format("{} of {} ticks", latency->missed_deadlines, latency->ticks)});
}

}  // namespace microswarm::report
