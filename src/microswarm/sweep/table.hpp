// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "microswarm/experiment/trials.hpp"
#include "microswarm/sweep/database.hpp"
#include "microswarm/sweep/plan.hpp"

namespace microswarm::sweep {

/// Type of a column of the trials table.
enum class SweepColumnKind { whole, real, text };
constexpr auto enum_names(SweepColumnKind) {
  return std::array<std::pair<SweepColumnKind, std::string_view>, 3>{
      {{SweepColumnKind::whole, "INTEGER"},
       {SweepColumnKind::real, "REAL"},
       {SweepColumnKind::text, "TEXT"}}};
}

/// One column of the trials table.
struct SweepColumn {
  std::string name{};  ///< letters, digits and underscores; ends with its unit
  SweepColumnKind kind = SweepColumnKind::real;
  std::string unit{};  ///< for display
  std::string description{};
  /// Role of the column; wall-clock times differ from run to run.
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

/// All columns of a sweep's table, in order: cell, trial, method, the grid parameters, results,
/// metrics, wall-clock times, the record's hash. Throws InputError for duplicate column names.
std::vector<SweepColumn> sweep_columns(const SweepPlan& plan);

/// Values of a row's columns up to the grid parameters.
std::vector<SqlValue> task_values(const SweepPlan& plan, const std::vector<SweepColumn>& columns,
                                  const SweepTask& task);

/// Values of the remaining columns.
std::vector<SqlValue> result_values(const experiment::TrialResult& trial);

/// A finished trial and its `result_values`.
struct SweepRow {
  SweepTask task{};
  std::vector<SqlValue> values{};
};

/// Storage of a sweep's rows.
class SweepStore {
 public:
  virtual ~SweepStore() = default;
  /// Trials without a row, cell by cell.
  virtual std::vector<SweepTask> missing() const = 0;
  virtual void add(const std::vector<SweepRow>& rows) = 0;
};

/// Rows in memory.
class SweepTable : public SweepStore {
 public:
  /// The plan must outlive it.
  explicit SweepTable(const SweepPlan& plan);

  std::vector<SweepTask> missing() const override;
  void add(const std::vector<SweepRow>& rows) override;
  const std::vector<SweepColumn>& columns() const { return columns_; }
  /// Values of the trials that have a row, cell by cell; valid until rows are added.
  std::vector<std::span<const SqlValue>> rows() const;

 private:
  const SweepPlan& plan_;
  std::vector<SweepColumn> columns_;
  std::vector<std::vector<SqlValue>> rows_;  ///< empty without a row
};

}  // namespace microswarm::sweep
