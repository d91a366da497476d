// SPDX-License-Identifier: Apache-2.0
#include "microswarm/io/hdf5_tables.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "microswarm/core/text/lines.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/io/tables.hpp"

namespace microswarm::io {
namespace {

constexpr const char* words_attribute = "words";  // joined by spaces, indexed from 0

std::vector<std::string> split_words(const std::string& joined) {
  const std::vector<std::string_view> list = split(joined, ' ');
  return {list.begin(), list.end()};
}

struct TableWriter {
  Hdf5Writer& file;

  void table(const std::string& group, const ListRef<const void*>& list) {
    std::vector<const void*> rows;
    for (std::size_t i = 0; i < list.size(); ++i) rows.push_back(list.row(i));
    write(group, to_columns(list.row_type()), rows);
  }
  void parts(const std::string& group, const ListRef<const void*>& outer, const Field& field) {
    std::vector<const void*> rows;
    std::vector<std::int64_t> offsets{0};
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const auto part = outer.part(i, field);
      for (std::size_t k = 0; k < part.size(); ++k) rows.push_back(part.row(k));
      offsets.push_back(static_cast<std::int64_t>(rows.size()));
    }
    write(group, to_columns(*field.type->parts[0], ColumnUnits::held, field.info.unit), rows);
    file.dataset(group + "/offset", offsets);
    file.attribute(group + "/offset", "description",
                   "Row i of the table above owns offset[i] to offset[i + 1] - 1, counted from 0.");
  }

 private:
  void write(const std::string& group, const std::vector<Column>& columns,
             const std::vector<const void*>& rows) {
    for (const Column& column : columns) {
      const std::string path = group + "/" + column.key;
      if (column.kind == ColumnKind::real) {
        std::vector<double> values;
        values.reserve(rows.size());
        for (const void* row : rows) values.push_back(column.number(row));
        file.dataset(path, values);
      } else {
        write_integers(path, column, rows);
      }
      file.attribute(path, "unit", unit_symbol(column.unit));
      file.attribute(path, "description", column.doc);
    }
  }
  void write_integers(const std::string& path, const Column& column,
                      const std::vector<const void*>& rows) {
    std::vector<std::int64_t> values;
    values.reserve(rows.size());
    std::vector<std::string> words;
    for (const void* row : rows)
      values.push_back(column.kind == ColumnKind::word ? find_or_append(column.word(row), words)
                                                       : column.integer(row));
    file.dataset(path, values);
    if (column.kind != ColumnKind::word) return;
    std::string joined;
    for (const std::string& word : words) joined += (joined.empty() ? "" : " ") + word;
    file.attribute(path, words_attribute, joined);
  }
  static std::int64_t find_or_append(std::string_view word, std::vector<std::string>& words) {
    auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) found = words.insert(words.end(), std::string(word));
    return found - words.begin();
  }
};

struct TableReader {
  const Hdf5Reader& file;
  /// Whether columns may be absent, except the first: files of former versions lack some. Their
  /// values stay as they are.
  bool may_lack_columns = false;

  void table(const std::string& group, const ListRef<void*>& list) {
    read(group, present(group, to_columns(list.row_type())), list);
  }
  void parts(const std::string& group, const ListRef<void*>& outer, const Field& field) {
    const std::vector<std::int64_t> offsets = file.integers(group + "/offset");
    if (offsets.size() != outer.size() + 1 || offsets.front() != 0 ||
        !std::is_sorted(offsets.begin(), offsets.end()))
      file.fail(group + "/offset does not fit its table");
    const Type& row = *field.type->parts[0];
    const std::vector<Column> columns =
        present(group, to_columns(row, ColumnUnits::held, field.info.unit));
    std::vector<void*> rows;
    // Checked before memory is allocated for rows that do not exist.
    if (row_bytes(group, columns.front()) != static_cast<std::size_t>(offsets.back()))
      file.fail(group + "/offset does not fit its table");
    check_lengths(group, columns, static_cast<std::size_t>(offsets.back()));
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const auto part = outer.part(i, field);
      part.resize(static_cast<std::size_t>(offsets[i + 1] - offsets[i]));
      for (std::size_t k = 0; k < part.size(); ++k) rows.push_back(part.row(k));
    }
    for (const Column& column : columns) read(group, column, rows);
  }

 private:
  std::vector<Column> present(const std::string& group, std::vector<Column> columns) const {
    if (!may_lack_columns || columns.empty()) return columns;
    const auto absent = [&](const Column& column) {
      return !file.has_attribute(group + "/" + column.key, "unit");
    };
    columns.erase(std::remove_if(columns.begin() + 1, columns.end(), absent), columns.end());
    return columns;
  }
  void read(const std::string& group, const std::vector<Column>& columns,
            const ListRef<void*>& list) {
    const std::size_t size = row_bytes(group, columns.front());
    check_lengths(group, columns, size);
    list.resize(size);
    std::vector<void*> rows;
    for (std::size_t i = 0; i < size; ++i) rows.push_back(list.row(i));
    for (const Column& column : columns) read(group, column, rows);
  }
  std::size_t row_bytes(const std::string& group, const Column& column) {
    return file.length(group + "/" + column.key);
  }
  /// All columns before memory is allocated for their rows.
  void check_lengths(const std::string& group, const std::vector<Column>& columns,
                     std::size_t rows) {
    for (const Column& column : columns)
      check_length(group + "/" + column.key, row_bytes(group, column), rows);
  }
  void read(const std::string& group, const Column& column, const std::vector<void*>& rows) {
    const std::string path = group + "/" + column.key;
    if (column.kind == ColumnKind::real) {
      const std::vector<double> values = file.numbers(path);
      check_length(path, values.size(), rows.size());
      for (std::size_t i = 0; i < rows.size(); ++i) column.set_number(rows[i], values[i]);
      return;
    }
    const std::vector<std::int64_t> values = file.integers(path);
    check_length(path, values.size(), rows.size());
    const bool has_words = column.kind == ColumnKind::word;
    const std::vector<std::string> known =
        has_words ? split_words(file.text_attribute(path, words_attribute))
                  : std::vector<std::string>{};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (has_words && !std::in_range<std::size_t>(values[i]))
        file.fail(path + " has a value without a word");
      if (has_words && static_cast<std::size_t>(values[i]) >= known.size())
        file.fail(path + " has a value without a word");
      if (has_words && !column.set_word(rows[i], known[static_cast<std::size_t>(values[i])]))
        file.fail(path + " has an unknown word");
      if (!has_words && !column.set_integer(rows[i], values[i]))
        file.fail(path + " has a value out of range");
    }
  }
  void check_length(const std::string& path, std::size_t found, std::size_t rows) {
    if (found != rows) file.fail(path + " is not as long as its table");
  }
};

}  // namespace

void write_tables(Hdf5Writer& out, const Type& type, const void* value) {
  visit_tables(type, value, TableWriter{out});
}

void read_tables(const Hdf5Reader& in, const Type& type, void* value) {
  visit_tables(type, value, TableReader{in});
}

void write_table(Hdf5Writer& out, const Field& field, const void* value, std::string_view parent) {
  visit_table(field, value, TableWriter{out}, parent);
}

void read_table(const Hdf5Reader& in, const Field& field, void* value, std::string_view parent) {
  visit_table(field, value, TableReader{in, true}, parent);
}

void write_attributes(Hdf5Writer& out, const std::string& group, const Type& type,
                      const void* value) {
  for (const Column& column : to_columns(type)) {
    if (column.kind == ColumnKind::real)
      out.attribute(group, column.key.c_str(), column.number(value));
    else
      out.attribute(group, column.key.c_str(), static_cast<std::int64_t>(column.number(value)));
  }
}

void read_attributes(const Hdf5Reader& in, const std::string& group, const Type& type,
                     void* value) {
  for (const Column& column : to_columns(type)) {
    const char* name = column.key.c_str();
    const double number = column.kind == ColumnKind::real
                              ? in.number_attribute(group, name)
                              : static_cast<double>(in.integer_attribute(group, name));
    if (!column.set_number(value, number)) in.fail("attribute " + column.key + " is out of range");
  }
}

}  // namespace microswarm::io
