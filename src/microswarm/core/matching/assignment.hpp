// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "microswarm/core/execution/stop.hpp"

namespace microswarm {

/// An allowed pair and its cost.
struct AssignmentEdge {
  int row = 0;
  int column = 0;
  double cost = 0;
};

/// Minimum-cost assignment of rows to columns, at most one each. The total cost is the sum of the
/// pairs' costs plus `alone` for each unpaired row. Uses shortest augmenting paths with potentials
/// [jonker]. A search stays within the rows and columns connected to its start, so scattered robots
/// cost little more than a pass over the edges.
///
/// [jonker] R. Jonker and A. Volgenant, A shortest augmenting path algorithm for dense and sparse
/// linear assignment problems, Computing 38, 325 (1987).
class Assignment {
 public:
  /// The column of each row; empty for an unpaired row. `edges` are sorted by row; duplicates are
  /// allowed. Costs are finite; those above `alone` are never used. The choice among equally good
  /// solutions is deterministic. If stopped, rows that were not reached are alone. Valid until the
  /// next call.
  const std::vector<std::optional<int>>& solve(int rows, int columns,
                                               const std::vector<AssignmentEdge>& edges,
                                               double alone, const Stop& stop = {});

 private:
  struct Reached {
    double distance;
    int column;
    friend bool operator>(const Reached& a, const Reached& b) {
      return a.distance != b.distance ? a.distance > b.distance : a.column > b.column;
    }
  };

  void begin(int rows, int columns, const std::vector<AssignmentEdge>& edges);
  bool take_cheapest(int row, const std::vector<AssignmentEdge>& edges, double alone);
  void augment(int row, const std::vector<AssignmentEdge>& edges, double alone);
  void reach(int column, int from, double distance);
  void settle_potentials(double shortest);

  std::vector<std::size_t> first_edge_;  ///< of each row, and one beyond the last
  std::vector<std::optional<int>> column_of_;
  std::vector<std::optional<int>> row_of_;
  std::vector<double> row_potential_;
  std::vector<double> column_potential_;
  // State of one search:
  std::vector<double> distance_;  ///< of each column; infinite if not reached
  std::vector<int> from_;         ///< row from which a column was reached
  std::vector<bool> done_;
  std::vector<int> touched_;  ///< columns reached
  std::vector<Reached> heap_;
};

}  // namespace microswarm
