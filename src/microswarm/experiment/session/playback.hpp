// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "microswarm/experiment/session/source.hpp"

namespace microswarm::experiment {

/// The scenario of a record with all changes until a time [s].
Scenario scenario_at(const Record& record, double t);

/// Plays back a record tick by tick. Nothing is recomputed: paths, plans and robots are the newest
/// ones in the record, and the trajectories between ticks are missing.
class Playback : public SessionSource {
 public:
  explicit Playback(Record record);

  const Tick* step(const Stop& stop = {}) override;
  /// A record cannot be changed.
  Issues set(const std::string& key, const std::string& value) override;
  std::optional<std::size_t> seek(std::size_t frame) override;
  const Record* record() const override { return &record_; }
  /// The scenario with all changes up to the current frame.
  const Scenario& scenario() const override { return scenario_; }
  const World& world() const override { return world_; }

 private:
  void apply_changes(std::size_t frame);
  double decided_at(std::size_t frame) const;

  Record record_;
  Scenario scenario_;
  World world_;
  std::size_t next_ = 0;
  std::size_t changed_ = 0;  ///< number of changes applied so far
  Tick tick_;
  std::optional<Snapshot> snapshot_;
  std::vector<std::string> changes_;
};

}  // namespace microswarm::experiment
