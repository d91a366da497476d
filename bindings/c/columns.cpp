// SPDX-License-Identifier: Apache-2.0
// Recorded quantities by name, out of the declaration of a frame.
#include <algorithm>

#include "handles.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/io/columns.hpp"

using namespace microswarm;

namespace {

/// The columns of a frame, and the same for C.
struct FrameColumns {
  std::vector<io::Column> columns = io::to_columns<experiment::Frame>();
  std::vector<std::vector<const char*>> words{};
  std::vector<ms_column> shown{};

  FrameColumns() {
    words.reserve(columns.size());
    for (const io::Column& column : columns) {
      const bool is_word = column.kind == io::ColumnKind::word;
      std::vector<const char*>& list = words.emplace_back();
      if (is_word)
        for (const std::string_view word : column.type().words) list.push_back(word.data());
      const bool is_boolean = column.type().kind == TypeKind::boolean;
      shown.push_back({.name = column.key.c_str(),
                       .unit = unit_symbol(column.unit).data(),
                       .meaning = column.doc.c_str(),
                       .words = list.empty() ? nullptr : list.data(),
                       .word_count = list.size(),
                       .kind = is_word                                  ? MS_WORD
                               : is_boolean                             ? MS_BOOLEAN
                               : column.kind == io::ColumnKind::integer ? MS_INTEGER
                                                                        : MS_REAL,
                       .reserved = 0});
    }
  }
};

/// Lives to the end of the process, as do the names and units returned from it.
const FrameColumns& frame_columns() {
  static const auto* const all = new FrameColumns;  // NOLINT(cppcoreguidelines-owning-memory)
  return *all;
}

const io::Column& column_named(std::string_view name) {
  std::vector<std::string_view> names;
  for (const io::Column& column : frame_columns().columns) {
    if (column.key == name) return column;
    names.emplace_back(column.key);
  }
  const std::string_view near = nearest_word(name, names);
  throw InputError("there is no recorded quantity " + quote(name) +
                   (near.empty() ? "" : ", did you mean " + quote(near) + "?"));
}

double column_value(const io::Column& column, const experiment::Frame& frame) {
  if (column.kind != io::ColumnKind::word) return column.number(&frame);
  const std::vector<std::string_view>& words = column.type().words;
  const auto found = std::ranges::find(words, column.word(&frame));
  return found == words.end() ? c::not_there : static_cast<double>(found - words.begin());
}

int32_t show_numbers(c::Object& object, const double** values, std::size_t* count) {
  *count = object.numbers.size();
  *values = object.numbers.empty() ? nullptr : object.numbers.data();
  return MS_OK;
}

}  // namespace

int32_t ms_frame_columns(const ms_column** columns, size_t* count) {
  return c::guarded([&]() -> int32_t {
    c::require(columns, "columns"), c::require(count, "count");
    *columns = frame_columns().shown.data();
    *count = frame_columns().shown.size();
    return MS_OK;
  });
}

int32_t ms_session_column(uint64_t handle, const char* name, const double** values, size_t* count) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object& object) -> int32_t {
    c::require(name, "name"), c::require(values, "values"), c::require(count, "count");
    const io::Column& column = column_named(name);
    object.numbers.clear();
    for (const experiment::Frame& frame : session.record().frames)
      object.numbers.push_back(column_value(column, frame));
    return show_numbers(object, values, count);
  });
}

int32_t ms_session_values(uint64_t handle, const double** values, size_t* count) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object& object) -> int32_t {
    c::require(values, "values"), c::require(count, "count");
    const experiment::Frame frame = object.frame ? *object.frame : session.view().frame;
    object.numbers.clear();
    for (const io::Column& column : frame_columns().columns)
      object.numbers.push_back(column_value(column, frame));
    return show_numbers(object, values, count);
  });
}
