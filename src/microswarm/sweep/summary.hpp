// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/sweep/sweep_database.hpp"

namespace microswarm::sweep {

/// Summary of the trials of one cell.
struct CellSummary {
  std::size_t cell = 0;
  std::string method{};
  std::vector<SqlValue> parameters{};  ///< grid values, in grid order
  std::size_t trials = 0;
  std::size_t arrived = 0;
  std::map<std::string, std::size_t> endings{};  ///< trials by status
  /// Median of each metric and wall-clock time over the trials that arrived (nearest rank), by
  /// column; absent when none arrived.
  std::map<std::string, double> medians{};

  /// Share of the trials that arrived; 0 without trials.
  double share_arrived() const {
    return trials ? static_cast<double>(arrived) / static_cast<double>(trials) : 0;
  }
};

/// Summary of every cell, in order; zeros for a cell without trials.
std::vector<CellSummary> summarise(const SweepReader& sweep);

}  // namespace microswarm::sweep
