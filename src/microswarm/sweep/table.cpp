// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "microswarm/config/number.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/io/columns.hpp"

namespace microswarm::sweep {
namespace {

using Role = SweepColumn::Role;

/// Columns and values of a trial's outcome, side by side.
struct Results {
  std::vector<SweepColumn> columns;
  std::vector<SqlValue> values;

  void add(SweepColumn column, SqlValue value) {
    columns.push_back(std::move(column));
    values.push_back(std::move(value));
  }
  void add_seconds(const std::string& name, const std::string& doc, double seconds) {
    add({name, SweepColumnKind::real, "s", doc, Role::wall_clock}, seconds);
  }
};

Results to_results(const experiment::TrialResult& trial) {
  Results r;
  const experiment::RunResult& run = trial.result;
  r.add({"status", SweepColumnKind::text, "", "How it ended.", Role::result},
        std::string(to_string(run.status)));
  r.add(
      {"arrived", SweepColumnKind::whole, "", "1 when the goal was reached, else 0.", Role::result},
      std::int64_t{run.status == Status::solved});
  for (const io::Column& column : io::to_columns<experiment::Metrics>()) {
    const double value = column.number(&run.metrics);
    const bool real = column.kind == io::ColumnKind::real;
    r.add({column.key, real ? SweepColumnKind::real : SweepColumnKind::whole,
           std::string(unit_symbol(column.unit)), column.doc, Role::metric},
          real ? SqlValue{value} : SqlValue{static_cast<std::int64_t>(value)});
  }
  const experiment::TimeSummary planning = experiment::summarise(run.timing.planning);
  const experiment::TimeSummary steps = experiment::summarise(run.timing.steps);
  r.add_seconds("planning_mean_s", "Wall clock: a step in which it planned, on average.",
                planning.mean);
  r.add_seconds("planning_max_s", "Wall clock: the longest of these.", planning.max);
  r.add_seconds("step_mean_s", "Wall clock: a step of the navigator, on average.", steps.mean);
  r.add_seconds("step_max_s", "Wall clock: the longest of these.", steps.max);
  r.add_seconds("compute_s", "Wall clock: all steps of the navigator.",
                std::accumulate(run.timing.steps.begin(), run.timing.steps.end(), 0.0));
  r.add({"record_hash", SweepColumnKind::text, "", "Fingerprint of all that is physical.",
         Role::result},
        trial.hash);
  return r;
}

std::string column_name(std::string_view key) {
  std::string name(key);
  for (char& c : name) {
    const bool word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!word) c = '_';
  }
  return name;
}

SweepColumnKind column_kind(const std::vector<std::string>& values) {
  SweepColumnKind kind = SweepColumnKind::whole;
  for (const std::string& value : values) {
    const auto number = parse_number(value);
    if (!number) return SweepColumnKind::text;
    if (*number != std::floor(*number) || std::abs(*number) > 1e15) kind = SweepColumnKind::real;
  }
  return kind;
}

SqlValue to_value(const std::string& text, SweepColumnKind kind) {
  if (kind == SweepColumnKind::text) return text;
  const double number = parse_number(text).value_or(0);
  if (kind == SweepColumnKind::real) return number;
  return static_cast<std::int64_t>(number);
}

constexpr std::size_t first_parameter = 3;

}  // namespace

std::vector<SweepColumn> sweep_columns(const SweepPlan& plan) {
  std::vector<SweepColumn> columns = {
      {"cell", SweepColumnKind::whole, "", "Combination of values and method, from 0.", Role::key},
      {"trial", SweepColumnKind::whole, "", "Trial of the seed, from 0.", Role::key},
      {"method", SweepColumnKind::text, "", "The method's name.", Role::key}};
  std::vector<SweepColumn> results = to_results({}).columns;
  for (const SweepParameter& parameter : plan.sweep.grid)
    columns.push_back({column_name(parameter.key), column_kind(parameter.values), "",
                       "Set by the sweep: " + parameter.key, Role::parameter});
  columns.insert(columns.end(), results.begin(), results.end());
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t k = i + 1; k < columns.size(); ++k)
      if (columns[i].name == columns[k].name)
        throw InputError(
            plan.file, fmt::format("the table would have two columns {}", quote(columns[i].name)));
  return columns;
}

std::vector<SqlValue> task_values(const SweepPlan& plan, const std::vector<SweepColumn>& columns,
                                  const SweepTask& task) {
  const SweepCell& cell = plan.cells[task.cell];
  std::vector<SqlValue> values = {std::int64_t{task.cell}, std::int64_t{task.trial}, cell.method};
  for (std::size_t i = 0; i < cell.values.size(); ++i)
    values.push_back(to_value(cell.values[i], columns[first_parameter + i].kind));
  return values;
}

std::vector<SqlValue> result_values(const experiment::TrialResult& trial) {
  return to_results(trial).values;
}

SweepTable::SweepTable(const SweepPlan& plan)
    : plan_(plan),
      columns_(sweep_columns(plan)),
      rows_(plan.cells.size() * static_cast<std::size_t>(plan.sweep.trials)) {}

std::vector<SweepTask> SweepTable::missing() const {
  const auto trials = static_cast<std::size_t>(plan_.sweep.trials);
  std::vector<SweepTask> tasks;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].empty())
      tasks.push_back(
          {static_cast<std::uint32_t>(i / trials), static_cast<std::uint32_t>(i % trials)});
  return tasks;
}

void SweepTable::add(const std::vector<SweepRow>& rows) {
  for (const SweepRow& row : rows) {
    std::vector<SqlValue> values = task_values(plan_, columns_, row.task);
    values.insert(values.end(), row.values.begin(), row.values.end());
    rows_[std::size_t{row.task.cell} * static_cast<std::size_t>(plan_.sweep.trials) +
          row.task.trial] = std::move(values);
  }
}

std::vector<std::span<const SqlValue>> SweepTable::rows() const {
  std::vector<std::span<const SqlValue>> all;
  for (const auto& row : rows_)
    if (!row.empty()) all.emplace_back(row);
  return all;
}

}  // namespace microswarm::sweep
