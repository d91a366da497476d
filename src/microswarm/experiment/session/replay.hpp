// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/experiment/record/record.hpp"

namespace microswarm::experiment {

/// Result of a replay.
struct ReplayResult {
  bool identical = false;
  bool stopped = false;      ///< stopped by the caller
  std::string difference{};  ///< first difference, as text; empty if identical
};

/// Runs the stored scene again and compares it up to the record's last frame. Throws InputError for
/// a run on a rig.
ReplayResult replay(const Record& record, const Stop& stop = {});

}  // namespace microswarm::experiment
