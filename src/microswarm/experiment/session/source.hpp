// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/run/operation.hpp"
#include "microswarm/experiment/run/tick.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {

/// Source of a session's ticks: an experiment that runs, or a record that is played back.
class SessionSource {
 public:
  virtual ~SessionSource() = default;
  /// The next tick; null after the last one. Valid until the next call.
  virtual const Tick* step(const Stop& stop) = 0;
  /// Sets a scenario value from the next tick on. If there are issues, nothing changes.
  virtual Issues set(const std::string& key, const std::string& value) = 0;
  /// Null if nobody can operate it.
  virtual Operation* operation() { return nullptr; }
  /// Sets the frame of the next step, clamped to the last one, and returns its number; nothing if
  /// it has only the newest tick.
  virtual std::optional<std::size_t> seek(std::size_t frame) {
    (void)frame;
    return std::nullopt;
  }
  /// Positions of the robots before the first tick [µm]; none for a swarm or if unknown.
  virtual std::vector<Vec2> first_robots() const { return {}; }
  /// The current scenario with all changes.
  virtual const Scenario& scenario() const = 0;
  virtual const World& world() const = 0;
  /// The record that is played back; null for an experiment that runs.
  virtual const Record* record() const { return nullptr; }
};

}  // namespace microswarm::experiment
