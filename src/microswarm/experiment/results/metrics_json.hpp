// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "microswarm/experiment/results/metrics.hpp"

namespace microswarm::experiment {

/// Every metric under the name of its attribute in a record, with its unit: "turning_rad",
/// "walls_clearance_um". A number that is not finite is null.
nlohmann::ordered_json metrics_json(const Metrics& metrics);

/// The same, and behind it the names of 0.2.0, which are read for one more release: "turning_deg",
/// and "walls", "obstacles" and "avoidance" as objects.
nlohmann::ordered_json metrics_json_with_former_names(const Metrics& metrics);

}  // namespace microswarm::experiment
