// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/summary.hpp"
#include "microswarm/core/fields/overloaded.hpp"

#include "microswarm/core/maths/statistics.hpp"

namespace microswarm::sweep {
namespace {

using Role = SweepColumn::Role;

std::optional<double> to_number(const SqlValue& value) {
  using Number = std::optional<double>;
  return std::visit(
      Overloaded{[](const OneOf<std::int64_t, double> auto& number) {
                   return Number(static_cast<double>(number));
                 },
                 [](const OneOf<std::monostate, std::string> auto&) { return Number(); }},
      value);
}

bool is_measured(const SweepColumn& column) {
  return column.role == Role::metric || column.role == Role::wall_clock;
}

CellSummary summarise_cell(const SweepReader& sweep, std::size_t cell) {
  const std::vector<SweepColumn>& columns = sweep.columns();
  const std::size_t method = sweep.column("method"), status = sweep.column("status"),
                    arrived = sweep.column("arrived");
  CellSummary summary{.cell = cell};
  std::vector<std::vector<double>> values(columns.size());
  sweep.each_row(
      [&](std::span<const SqlValue> row) {
        if (summary.trials++ == 0) {
          if (const auto* name = std::get_if<std::string>(&row[method])) summary.method = *name;
          for (std::size_t i = 0; i < columns.size(); ++i)
            if (columns[i].role == Role::parameter) summary.parameters.push_back(row[i]);
        }
        if (const auto* word = std::get_if<std::string>(&row[status])) ++summary.endings[*word];
        if (to_number(row[arrived]).value_or(0) == 0) return;
        ++summary.arrived;
        for (std::size_t i = 0; i < columns.size(); ++i)
          if (const auto number = to_number(row[i]); number && is_measured(columns[i]))
            values[i].push_back(*number);
      },
      cell);
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (!values[i].empty()) summary.medians[columns[i].name] = median(values[i]);
  return summary;
}

}  // namespace

std::vector<CellSummary> summarise(const SweepReader& sweep) {
  std::vector<CellSummary> summaries;
  for (std::size_t cell = 0; cell < sweep.cells(); ++cell)
    summaries.push_back(summarise_cell(sweep, cell));
  return summaries;
}

}  // namespace microswarm::sweep
