// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/config/type.hpp"

namespace microswarm::io {

/// Type of a column. Reals are NaN where there is no value.
enum class ColumnKind { real, integer, word };

/// Unit of a column's numbers: as stored (angles in rad) or as displayed (angles in deg).
enum class ColumnUnits { held, shown };

/// One quantity of rows described by `fields`: a field or a field nested in one.
class Column {
 public:
  std::string key;  ///< names joined by underscores, with the unit's suffix
  Unit unit = Unit::none;
  std::string doc;
  ColumnKind kind = ColumnKind::real;

  /// Type of the value, without the optionals around it.
  const Type& type() const { return *type_; }
  /// Value of a real or integer column.
  double number(const void* row) const;
  /// Value of an integer column; -1 where there is none.
  std::int64_t integer(const void* row) const;
  /// False if the value is outside the field's range.
  bool set_number(void* row, double value) const;
  /// The same for an integer column, where -1 is no value of an optional field.
  bool set_integer(void* row, std::int64_t value) const;
  /// Value of a word column.
  std::string_view word(const void* row) const;
  /// False if the word does not exist.
  bool set_word(void* row, std::string_view word) const;
  /// The number or word as in a CSV file; empty if there is no value.
  std::string text(const void* row) const;

 private:
  friend class ColumnLister;

  /// Field within its parent; optionals are entered.
  struct Step {
    std::size_t offset = 0;
    const Type* optional = nullptr;
  };

  const void* in(const void* row) const;

  const Type* type_ = nullptr;
  std::vector<Step> steps_;
  double scale_ = 1;  ///< written value per stored value
};

/// Columns of such rows, in the order of their fields. Lists are not columns; see visit_tables. A
/// row of type Vec2 has the columns x and y in `unit`.
std::vector<Column> to_columns(const Type& row, ColumnUnits units = ColumnUnits::held,
                               Unit unit = Unit::um);
template <class Row>
std::vector<Column> to_columns(ColumnUnits units = ColumnUnits::held) {
  return to_columns(type_of<Row>(), units);
}

/// Text as a CSV field, quoted if necessary.
std::string csv_text(std::string_view text);

/// CSV header (the columns' keys, comma-separated) and the CSV line of a row.
std::string csv_head(const std::vector<Column>& columns);
std::string csv_line(const std::vector<Column>& columns, const void* row);

/// CSV of rows described by `fields`: the header and a line each, in the units of people.
template <class Rows>
std::string csv_table(const Rows& rows) {
  const auto columns = to_columns<typename Rows::value_type>(ColumnUnits::shown);
  std::string csv = csv_head(columns) + "\n";
  for (const auto& row : rows) csv.append(csv_line(columns, &row)).append("\n");
  return csv;
}

}  // namespace microswarm::io
