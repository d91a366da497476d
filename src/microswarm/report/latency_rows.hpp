// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/experiment/record/record.hpp"

namespace microswarm {

/// Adds how long pictures waited for their currents to a table of quantities and values; nothing
/// for a record that is not of a rig.
void add_latency_rows(std::vector<std::vector<std::string>>& table, const Record& record);

}  // namespace microswarm
