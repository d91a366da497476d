// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/sweep/sweep_database.hpp"

namespace microswarm {

/// What the trials of one cell come to.
struct CellSummary {
  std::size_t cell = 0;
  std::string method;
  std::vector<SqlValue> parameters;  ///< the grid's values, in its order
  std::size_t trials = 0;
  std::size_t arrived = 0;
  std::map<std::string, std::size_t> endings;  ///< trials by status
  /// By column, each metric and wall-clock time: the median over the trials that arrived (nearest
  /// rank, a value that occurred); missing when none did.
  std::map<std::string, double> medians;

  double share_arrived() const {
    return trials ? static_cast<double>(arrived) / static_cast<double>(trials) : 0;
  }
};

/// A summary of every cell, in order; a cell without trials yet has zeros.
std::vector<CellSummary> summarise(const SweepReader& sweep);

}  // namespace microswarm
