// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/experiment/record/record.hpp"

namespace microswarm::report {

/// Adds the latency from picture to currents to a table of quantities and values; does nothing for
/// a record without a rig.
void add_latency_rows(std::vector<std::vector<std::string>>& table,
                      const experiment::Record& record);

}  // namespace microswarm::report
