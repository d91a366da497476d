// SPDX-License-Identifier: Apache-2.0
// Many runs of a scenario.
#include "microswarm/sweep/sweep.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/sweep/same_runs.hpp"

#include <algorithm>

#include "calls.hpp"
#include "scenario_text.hpp"

namespace microswarm::python {
namespace {

using Grid = std::vector<std::pair<std::string, std::vector<std::string>>>;
using Methods = std::vector<std::pair<std::string, Given>>;
using namespace py::literals;  // NOLINT(google-build-using-namespace): _a
using Rows = std::vector<std::span<const sweep::SqlValue>>;

/// The scenario's settings without those that the sweep varies or sets.
Given unvaried(const Given& settings, const Grid& grid, bool has_seed) {
  Given all;
  std::ranges::copy_if(settings, std::back_inserter(all), [&](const Setting& setting) {
    return !(has_seed && setting.key == "seed") &&
           std::ranges::none_of(grid, [&](const auto& one) { return one.first == setting.key; });
  });
  return all;
}

/// Numbers of a column; NaN for missing ones.
template <class Number>
py::array_t<Number> numbers_in(const Rows& rows, std::size_t column) {
  py::array_t<Number> array(static_cast<py::ssize_t>(rows.size()));
  Number* out = array.mutable_data();
  for (const auto& row : rows)
    *out++ = std::visit(
        Overloaded{[](const OneOf<std::int64_t, double> auto& number) {
                     return static_cast<Number>(number);
                   },
                   [](const OneOf<std::monostate, std::string> auto&) {
                     return static_cast<Number>(std::numeric_limits<double>::quiet_NaN());
                   }},
        row[column]);
  return array;
}

py::object sweep_column(const Rows& rows, std::size_t column, sweep::SweepColumnKind kind) {
  if (kind == sweep::SweepColumnKind::text) {
    py::list texts;
    for (const auto& row : rows) texts.append(std::get<std::string>(row[column]));
    return py::module_::import("numpy").attr("array")(texts, "dtype"_a = "str");
  }
  const bool whole =
      kind == sweep::SweepColumnKind::whole && std::ranges::all_of(rows, [&](const auto& row) {
        return std::holds_alternative<std::int64_t>(row[column]);
      });
  if (whole) return numbers_in<std::int64_t>(rows, column);
  return numbers_in<double>(rows, column);
}

/// Columns of the table of trials, and their descriptions.
py::tuple to_columns(const sweep::SweepTable& table) {
  const Rows rows = table.rows();
  py::dict columns, docs;
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    const sweep::SweepColumn& column = table.columns()[i];
    columns[py::str(column.name)] = sweep_column(rows, i, column.kind);
    docs[py::str(column.name)] = column.description;
  }
  return py::make_tuple(columns, docs);
}

std::string same_runs_note(const sweep::SweepTable& table) {
  sweep::SameRuns runs(table.columns());
  for (const auto& row : table.rows()) runs.add(row);
  return runs.note();
}

/// The columns, and a note if trials are the same run. An interruption carries the columns of the
/// finished trials as `columns`.
py::tuple sweep_scenario(const ScenarioText& scenario, const Grid& grid, const Methods& methods,
                         int trials, std::optional<std::uint64_t> seed, int jobs,
                         const py::object& report) {
  const Given base = unvaried(scenario.settings, grid, seed.has_value());
  sweep::Sweep asked{.set = to_settings(base).texts(), .trials = trials, .seed = seed};
  for (const auto& [key, values] : grid) asked.grid.push_back({key, values});
  for (const auto& [name, set] : methods) asked.methods.push_back({name, to_settings(set).texts()});
  std::atomic<double> done = 0;
  sweep::SweepPlan plan;
  std::unique_ptr<sweep::SweepTable> table;
  try {
    interruptible(
        [&](const Stop& stop) {
          plan = sweep::plan_sweep(sweep::checked_sweep(std::move(asked), "sweep"), "sweep",
                                   {scenario.text, scenario.name, scenario.base}, jobs, stop);
          if (stop()) return false;
          check(plan, jobs, stop);
          table = std::make_unique<sweep::SweepTable>(plan);
          const sweep::Ranks alone = sweep::Ranks::alone();
          sweep::RemoteWorkers none(alone);
          const auto note = [&](const sweep::SweepProgress& p) {
            done = static_cast<double>(p.added) / static_cast<double>(p.added + p.left);
          };
          sweep::run_sweep(plan, *table, none, {.jobs = jobs, .progress = note}, stop);
          return true;
        },
        [&] {
          if (!report.is_none()) report(done.load());
        });
  } catch (py::error_already_set& interrupted) {
    if (table && interrupted.matches(PyExc_KeyboardInterrupt))
      interrupted.value().attr("columns") = to_columns(*table);
    throw;
  }
  warn(plan.notes);
  return py::make_tuple(to_columns(*table), same_runs_note(*table));
}

}  // namespace

void add_sweep(py::module_& module) { module.def("sweep", sweep_scenario); }

}  // namespace microswarm::python
