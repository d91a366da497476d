// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/experiment/session/session.hpp"

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

/// Runs the stored scene again up to this frame, with the same changes and steering, and leaves it
/// open: it continues as the run did, unless it is changed. `ticked` is called after each tick.
/// Null if the caller stopped it. Throws InputError for a run on a rig, with an external navigator,
/// or without this frame.
std::unique_ptr<Session> branch(const Record& record, std::size_t frame, const Stop& stop = {},
                                const std::function<void(const Session&)>& ticked = {});

}  // namespace microswarm::experiment
