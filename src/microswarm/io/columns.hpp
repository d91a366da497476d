// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/config/type.hpp"

namespace microswarm {

/// How a quantity is kept: reals are NaN where there is none.
enum class ColumnKind { real, integer, word };

/// The unit of a column's numbers: angles as they are held, in rad, or as people see them, in deg.
enum class ColumnUnits { held, shown };

/// One quantity of rows that are described by `fields`: a field, or what is nested in one.
class Column {
 public:
  std::string key;  ///< names joined by underscores, with the unit's suffix
  Unit unit = Unit::none;
  std::string doc;
  ColumnKind kind = ColumnKind::real;

  /// Of reals and integers.
  double number(const void* row) const;
  /// False when it is out of the field's range.
  bool set_number(void* row, double value) const;
  /// Of words.
  std::string_view word(const void* row) const;
  /// False when there is no such word.
  bool set_word(void* row, std::string_view word) const;
  /// The number or word as in a CSV file; empty where there is none.
  std::string text(const void* row) const;

 private:
  friend class ColumnLister;

  /// A field within what holds it; what is optional is entered.
  struct Step {
    std::size_t offset = 0;
    const Type* optional = nullptr;
  };

  const void* in(const void* row) const;

  const Type* type_ = nullptr;
  std::vector<Step> steps_;
  double scale_ = 1;  ///< of a number, per held
};

/// The columns of such rows, in the order of their fields. Lists are no columns: see described
/// tables. A row that is a Vec2 has the columns x and y, in `unit`.
std::vector<Column> columns_of(const Type& row, ColumnUnits units = ColumnUnits::held,
                               Unit unit = Unit::um);
template <class Row>
std::vector<Column> columns_of(ColumnUnits units = ColumnUnits::held) {
  return columns_of(type_of<Row>(), units);
}

/// A text as a field of a CSV file, in quotes where it must be.
std::string csv_text(std::string_view text);

/// The head of a CSV file: the columns' keys with commas between them, and of a row its values.
std::string csv_head(const std::vector<Column>& columns);
std::string csv_line(const std::vector<Column>& columns, const void* row);

}  // namespace microswarm
