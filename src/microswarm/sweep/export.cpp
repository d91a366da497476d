// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/export.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/io/hdf5_image.hpp"
#include "microswarm/io/tables.hpp"

namespace microswarm::sweep {
namespace {

std::string csv_value(const SqlValue& value) {
  return std::visit(Overloaded{[](std::monostate) { return std::string(); },
                               [](std::int64_t whole) { return std::to_string(whole); },
                               [](double real) { return number_text(real); },
                               [](const std::string& text) { return io::csv_text(text); }},
                    value);
}

/// Collects a column; integers stay integers unless one is missing.
struct Hdf5Column {
  std::vector<std::int64_t> wholes;
  std::vector<double> reals;
  std::vector<std::string> texts;

  void add(const SqlValue& value, SweepColumnKind kind) {
    const auto* whole = std::get_if<std::int64_t>(&value);
    const auto* real = std::get_if<double>(&value);
    if (kind == SweepColumnKind::text) {
      texts.push_back(csv_value_plain(value));
      return;
    }
    if (whole) wholes.push_back(*whole);
    reals.push_back(whole  ? static_cast<double>(*whole)
                    : real ? *real
                           : std::numeric_limits<double>::quiet_NaN());
  }
  static std::string csv_value_plain(const SqlValue& value) {
    const auto* text = std::get_if<std::string>(&value);
    return text ? *text : csv_value(value);
  }
};

/// Writes the requested table of a record and collects the names of all.
struct RecordTables {
  std::string wanted;
  std::vector<std::string> names;
  std::string csv;

  void table(const std::string& group, const io::ListRef<const void*>& list) {
    if (!is_wanted(group)) return;
    const std::vector<io::Column> columns = io::to_columns(list.row_type());
    csv += io::csv_head(columns) + "\n";
    for (std::size_t i = 0; i < list.size(); ++i) csv += io::csv_line(columns, list.row(i)) + "\n";
  }
  void parts(const std::string& group, const io::ListRef<const void*>& outer, const Field& field) {
    if (!is_wanted(group)) return;
    const std::vector<io::Column> columns = io::to_columns(*field.type->parts[0]);
    csv += "row," + io::csv_head(columns) + "\n";
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const io::ListRef<const void*> part = outer.part(i, field);
      for (std::size_t k = 0; k < part.size(); ++k)
        csv += fmt::format("{},{}\n", i, io::csv_line(columns, part.row(k)));
    }
  }

 private:
  bool is_wanted(const std::string& group) {
    names.push_back(group.substr(1));
    return names.back() == wanted;
  }
};

}  // namespace

std::string sweep_csv(const SweepReader& sweep) {
  std::string text;
  for (const SweepColumn& column : sweep.columns()) text += (text.empty() ? "" : ",") + column.name;
  text += "\n";
  sweep.each_row([&](std::span<const SqlValue> row) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text.append(i ? "," : "").append(csv_value(row[i]));
    text += "\n";
  });
  return text;
}

std::string sweep_hdf5(const SweepReader& sweep) {
  const auto made = io::write_hdf5();
  io::Hdf5Writer& out = *made;
  out.attribute("/", "format", "microswarm sweep");
  for (const char* key : {"version", "name", "seed", "host", "begun", "hash"})
    out.attribute("/", key, sweep.about(key));
  out.text("/sweep", sweep.about("sweep"));
  for (std::size_t i = 0; i < sweep.columns().size(); ++i) {
    const SweepColumn& column = sweep.columns()[i];
    Hdf5Column values;
    sweep.each_value(i, [&](const SqlValue& value) { values.add(value, column.kind); });
    const std::string path = "/trials/" + column.name;
    if (column.kind == SweepColumnKind::text)
      out.dataset(path, values.texts);
    else if (column.kind == SweepColumnKind::whole && values.wholes.size() == values.reals.size())
      out.dataset(path, values.wholes);
    else
      out.dataset(path, values.reals);
    out.attribute(path, "unit", column.unit);
    out.attribute(path, "description", column.description);
  }
  std::vector<std::string> scenarios;
  for (std::size_t cell = 0; cell < sweep.cells(); ++cell)
    scenarios.push_back(sweep.scenario(cell));
  out.dataset("/cells/scenario", scenarios);
  return out.finish();
}

std::string record_csv(const experiment::Record& record, const std::string& table) {
  RecordTables tables{.wanted = table, .names = {}, .csv = {}};
  io::visit_tables(type_of<experiment::Record>(), static_cast<const void*>(&record), tables);
  const void* log = &record.diagnostics;
  for (const Field& field : type_of<experiment::DiagnosticsLog>().fields)
    if (field.type->count(field.in(log)) > 0) io::visit_table(field, log, tables, "/diagnostics");
  if (tables.csv.empty())
    throw InputError(fmt::format(
        "the record has no table {}, only {}{}", quote(table), fmt::join(tables.names, ", "),
        record.diagnostics.empty() && !record.scene.scenario.record.diagnostics
            ? "; a run with record.diagnostics=true keeps those of diagnostics"
            : ""));
  return std::move(tables.csv);
}

}  // namespace microswarm::sweep
