// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/matching/assignment.hpp"

#include <algorithm>
#include <cassert>
#include <functional>

#include "microswarm/core/maths/infinity.hpp"

namespace microswarm {

const std::vector<std::optional<int>>& Assignment::solve(int rows, int columns,
                                                         const std::vector<AssignmentEdge>& edges,
                                                         double alone, const Stop& stop) {
  begin(rows, columns, edges);
  for (int row = 0; row < rows && !stop(); ++row)
    if (!take_cheapest(row, edges, alone)) augment(row, edges, alone);
  return column_of_;
}

void Assignment::begin(int rows, int columns, const std::vector<AssignmentEdge>& edges) {
  assert(std::is_sorted(edges.begin(), edges.end(),
                        [](const auto& a, const auto& b) { return a.row < b.row; }));
  first_edge_.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (const AssignmentEdge& edge : edges) {
    assert(edge.row >= 0 && edge.row < rows && edge.column >= 0 && edge.column < columns);
    ++first_edge_[edge.row + 1];
  }
  for (int row = 0; row < rows; ++row) first_edge_[row + 1] += first_edge_[row];
  column_of_.assign(static_cast<std::size_t>(rows), std::nullopt);
  row_of_.assign(static_cast<std::size_t>(columns), std::nullopt);
  row_potential_.assign(static_cast<std::size_t>(rows), 0);
  column_potential_.assign(static_cast<std::size_t>(columns), 0);
  distance_.assign(static_cast<std::size_t>(columns), infinity);
  from_.resize(static_cast<std::size_t>(columns));
  done_.assign(static_cast<std::size_t>(columns), false);
}

/// Sets the row's potential to its minimum reduced cost. Pairs the row at once if this disturbs no
/// other row, or leaves it alone if nothing is cheaper.
bool Assignment::take_cheapest(int row, const std::vector<AssignmentEdge>& edges, double alone) {
  double least = alone;
  std::optional<int> cheapest;
  for (std::size_t e = first_edge_[row]; e < first_edge_[row + 1]; ++e) {
    const double reduced = edges[e].cost - column_potential_[edges[e].column];
    if (reduced >= least) continue;
    least = reduced;
    cheapest = edges[e].column;
  }
  row_potential_[row] = least;
  if (!cheapest) return true;
  if (row_of_[*cheapest]) return false;
  column_of_[row] = cheapest;
  row_of_[*cheapest] = row;
  return true;
}

/// Dijkstra's search over reduced costs from an unpaired row to the nearest free column, or to the
/// nearest row that is better left alone. Then flips the pairs along the path.
void Assignment::augment(int start, const std::vector<AssignmentEdge>& edges, double alone) {
  touched_.clear();
  heap_.clear();
  double shortest = infinity;
  int row = start;
  double so_far = 0;
  std::optional<int> lone_row;  // the path ends with this row left alone
  std::optional<int> free_column;
  for (;;) {
    const double leave = so_far + alone - row_potential_[row];
    if (leave < shortest) {
      shortest = leave;
      lone_row = row;
    }
    for (std::size_t e = first_edge_[row]; e < first_edge_[row + 1]; ++e) {
      const int column = edges[e].column;
      reach(column, row, so_far + edges[e].cost - row_potential_[row] - column_potential_[column]);
    }
    std::optional<int> next;
    while (!heap_.empty() && !next) {
      std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
      const int column = heap_.back().column;
      heap_.pop_back();
      if (!done_[column]) next = column;
    }
    if (!next || distance_[*next] >= shortest) break;
    done_[*next] = true;
    if (!row_of_[*next]) {
      shortest = distance_[*next];
      free_column = next;
      break;
    }
    row = *row_of_[*next];
    so_far = distance_[*next];
  }
  settle_potentials(shortest);
  row_potential_[start] += shortest;

  std::optional<int> column = free_column;
  if (!column) {
    column = column_of_[*lone_row];
    column_of_[*lone_row].reset();
  }
  while (column) {  // back to the start
    const int paired = from_[*column];
    const std::optional<int> before = column_of_[paired];
    row_of_[*column] = paired;
    column_of_[paired] = column;
    if (paired == start) break;
    column = before;
  }
  for (const int c : touched_) {
    distance_[c] = infinity;
    done_[c] = false;
  }
}

void Assignment::reach(int column, int from, double distance) {
  if (done_[column] || distance >= distance_[column]) return;
  if (distance_[column] == infinity) touched_.push_back(column);
  distance_[column] = distance;
  from_[column] = from;
  heap_.push_back({distance, column});
  std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
}

/// Keeps every reduced cost non-negative and that of each pair at 0.
void Assignment::settle_potentials(double shortest) {
  for (const int column : touched_) {
    if (!done_[column]) continue;
    const double change = shortest - distance_[column];
    if (change <= 0) continue;
    column_potential_[column] -= change;
    if (row_of_[column]) row_potential_[*row_of_[column]] += change;
  }
}

}  // namespace microswarm
