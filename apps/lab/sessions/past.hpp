// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "microswarm/experiment/record/diagnostics_log.hpp"
#include "microswarm/experiment/results/metrics.hpp"
#include "microswarm/experiment/run/tick.hpp"

namespace microswarm::lab {

/// Parts of earlier ticks that a record does not keep, for looking back at a run: the diagnostics
/// of its navigator, and the metrics so far. Where there are too many, every second one is dropped.
class Past {
 public:
  static constexpr std::size_t max_bytes = std::size_t{64} << 20;  ///< of the diagnostics
  static constexpr std::size_t max_metrics = 4096;
  explicit Past(std::size_t bytes = max_bytes) : max_bytes_(bytes) {}

  /// Keeps a tick, the next one. Diagnostics that the record keeps are left out.
  void add(const experiment::Tick& tick, const experiment::Metrics& metrics, bool is_recorded);
  const experiment::DiagnosticsLog& diagnostics() const { return log_; }
  /// Diagnostics are kept of every such tick.
  std::uint64_t period() const { return period_; }
  /// The newest metrics kept that are not later than a frame; nothing if there are none.
  std::optional<experiment::Metrics> metrics(std::uint64_t frame) const;
  /// Approximate memory [B].
  std::size_t bytes() const {
    return bytes_ + tree_bytes_ + metrics_.size() * sizeof(experiment::Metrics);
  }

 private:
  void keep_tree(AggregationDiagnostics& plan);
  void halve();

  std::size_t max_bytes_;
  std::size_t bytes_ = 0;          ///< without trees
  std::size_t tree_bytes_ = 0;     ///< of trees, each kept once and never dropped
  AggregationDiagnostics tree_{};  ///< nodes and regions of the newest one
  std::uint64_t ticks_ = 0;
  std::uint64_t period_ = 1;
  std::uint64_t metrics_period_ = 1;
  experiment::DiagnosticsLog log_;
  std::vector<experiment::Metrics> metrics_;  ///< of every `metrics_period_` tick
};

}  // namespace microswarm::lab
