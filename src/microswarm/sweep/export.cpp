// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/export.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/error.hpp"
#include "microswarm/core/text.hpp"
#include "microswarm/experiment/record/hdf5_image.hpp"
#include "microswarm/experiment/record/record_layout.hpp"

namespace microswarm {
namespace {

std::string csv_text(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + "\"";
}

std::string csv_value(const SqlValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* real = std::get_if<double>(&value)) return number_text(*real);
  if (const auto* text = std::get_if<std::string>(&value)) return csv_text(*text);
  return "";
}

/// Collects a column; whole numbers stay whole as long as none is missing.
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

/// Writes the tables of a record that are asked for, and learns the names of all.
struct RecordTables {
  std::string wanted;
  std::vector<std::string> names;
  std::string csv;

  template <class Rows>
  void table(const std::string& group, const Rows& rows) {
    using Row = typename Rows::value_type;
    if (!is_wanted(group)) return;
    head<Row>("");
    for (const Row& row : rows) line(row, "");
  }
  template <class Rows, class Part>
  void parts(const std::string& group, const Rows& rows, Part part) {
    using Row = typename std::remove_cvref_t<decltype(part(rows.front()))>::value_type;
    if (!is_wanted(group)) return;
    head<Row>("row,");
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const Row& row : part(rows[i])) line(row, std::to_string(i) + ",");
  }

 private:
  bool is_wanted(const std::string& group) {
    names.push_back(group.substr(1));
    return names.back() == wanted;
  }
  template <class Row>
  void head(const std::string& first) {
    csv += first;
    const auto columns = columns_of(static_cast<const Row*>(nullptr));
    for (std::size_t i = 0; i < columns.size(); ++i) csv += (i ? "," : "") + columns[i].key;
    csv += "\n";
  }
  template <class Row>
  void line(const Row& row, const std::string& first) {
    static const auto columns = columns_of(static_cast<const Row*>(nullptr));
    csv += first;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (i) csv += ",";
      if (columns[i].kind == ColumnKind::word)
        csv += csv_text(columns[i].word(row));
      else if (const double number = columns[i].number(row); !std::isnan(number))
        csv += number_text(number);
    }
    csv += "\n";
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
  Hdf5Writer out;
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

std::vector<std::string> record_tables(const Record& record) {
  RecordTables tables;
  visit_tables(record, tables);
  return tables.names;
}

std::string record_csv(const Record& record, const std::string& table) {
  RecordTables tables{.wanted = table, .names = {}, .csv = {}};
  visit_tables(record, tables);
  if (tables.csv.empty())
    throw InputError(fmt::format("the record has no table {}, only {}", quote(table),
                                 fmt::join(tables.names, ", ")));
  return std::move(tables.csv);
}

}  // namespace microswarm
