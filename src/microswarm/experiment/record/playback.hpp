// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/run/tick.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// A record seen tick by tick, as the experiment was when it ran. Nothing is computed anew: paths,
/// plans and robots are the newest that the record holds, the ways between ticks are not there.
class Playback {
 public:
  explicit Playback(Record record);

  /// The next frame's tick; null after the last one. Valid until the next call.
  const Tick* step();
  /// The next step gives this frame; beyond the last one, the last. Its number.
  std::size_t seek(std::size_t frame);

  const Record& record() const { return record_; }
  /// The scenario with what was changed up to the present frame.
  const Scenario& scenario() const { return scenario_; }
  const World& world() const { return world_; }

 private:
  void apply_changes(std::size_t frame);

  Record record_;
  Scenario scenario_;
  World world_;
  std::size_t next_ = 0;
  std::size_t changed_ = 0;  ///< changes that hold by now
  Tick tick_;
  std::optional<Snapshot> snapshot_;
  std::vector<std::string> changes_;
};

}  // namespace microswarm
