// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/experiment/trials.hpp"
#include "microswarm/sweep/database.hpp"
#include "microswarm/sweep/plan.hpp"

namespace microswarm {

/// What a column of the table of trials holds.
enum class SweepColumnKind { whole, real, text };
constexpr auto enum_names(SweepColumnKind) {
  return std::array<std::pair<SweepColumnKind, std::string_view>, 3>{
      {{SweepColumnKind::whole, "INTEGER"},
       {SweepColumnKind::real, "REAL"},
       {SweepColumnKind::text, "TEXT"}}};
}

/// One column of the table of trials.
struct SweepColumn {
  std::string name;  ///< letters, digits and underscores; ends with its unit
  SweepColumnKind kind = SweepColumnKind::real;
  std::string unit;  ///< as people read it
  std::string description;
  /// What it is: of the cell, a metric, or a wall-clock time, which differs from run to run.
  enum class Role { key, parameter, result, metric, wall_clock } role = Role::result;
};
constexpr auto enum_names(SweepColumn::Role) {
  using Role = SweepColumn::Role;
  return std::array<std::pair<Role, std::string_view>, 5>{{{Role::key, "key"},
                                                           {Role::parameter, "parameter"},
                                                           {Role::result, "result"},
                                                           {Role::metric, "metric"},
                                                           {Role::wall_clock, "wall_clock"}}};
}

/// All columns of a sweep's table, in their order: cell, trial, method, one for each parameter of
/// the grid, what the trial came to, every metric, wall-clock times, the record's hash. Throws
/// InputError when a parameter's column would bear the name of another.
std::vector<SweepColumn> sweep_columns(const SweepPlan& plan);

/// The first part of a row, up to the parameters.
std::vector<SqlValue> task_values(const SweepPlan& plan, const std::vector<SweepColumn>& columns,
                                  const SweepTask& task);

/// The rest of it.
std::vector<SqlValue> result_values(const TrialResult& trial);

/// A trial that has run: which one, and its result_values.
struct SweepRow {
  SweepTask task;
  std::vector<SqlValue> values;
};

}  // namespace microswarm
