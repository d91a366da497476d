// SPDX-License-Identifier: Apache-2.0
#include "microswarm/io/columns.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/core/text/text.hpp"

namespace microswarm::io {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr double max_exact = 9007199254740992.0;  // 2^53

double greatest_value(TypeKind kind) {
  switch (kind) {
    case TypeKind::boolean:
      return 1;
    case TypeKind::integer:
      return std::numeric_limits<int>::max();
    case TypeKind::index:
      return std::numeric_limits<std::uint32_t>::max();
    default:
      return max_exact;
  }
}

/// "Least clearance to walls: from the swarm's centre."
std::string joined_doc(std::string_view outer, std::string_view inner) {
  if (outer.empty() || inner.empty()) return std::string(outer.empty() ? inner : outer);
  if (outer.ends_with('.')) outer.remove_suffix(1);
  std::string doc(outer);
  doc.append(": ").append(inner);
  char& first = doc[outer.size() + 2];
  if (first >= 'A' && first <= 'Z') first = static_cast<char>(first - 'A' + 'a');
  return doc;
}

}  // namespace

/// Visits a type's fields, including nested ones.
class ColumnLister {
 public:
  explicit ColumnLister(ColumnUnits units) : units_(units) {}

  void list(const Type& type, const FieldInfo& info, const std::string& name,
            const std::string& doc) {
    switch (type.kind) {
      case TypeKind::record:
        for (const Field& field : type.fields) {
          steps_.push_back({field.offset, nullptr});
          list(*field.type, field.info, inner(name, field.info.name),
               joined_doc(doc, field.info.doc));
          steps_.pop_back();
        }
        return;
      case TypeKind::optional:
        steps_.push_back({0, &type});
        list(*type.parts[0], info, name, doc);
        steps_.pop_back();
        return;
      case TypeKind::point:
        add(type_of<double>(), info, inner(name, "x"), joined_doc(doc, "to the right"),
            offsetof(Vec2, x));
        add(type_of<double>(), info, inner(name, "y"), joined_doc(doc, "upwards"),
            offsetof(Vec2, y));
        return;
      case TypeKind::list:
      case TypeKind::variant:
        return;
      default:
        add(type, info, name, doc, 0);
    }
  }

  std::vector<Column> take() { return std::move(columns_); }

 private:
  static std::string inner(const std::string& outer, std::string_view name) {
    if (name.empty()) return outer;
    return outer.empty() ? std::string(name) : outer + "_" + std::string(name);
  }

  void add(const Type& type, const FieldInfo& info, std::string name, const std::string& doc,
           std::size_t offset) {
    Column column;
    const bool shown = units_ == ColumnUnits::shown;
    column.unit = info.unit == Unit::deg && !shown ? Unit::rad : info.unit;
    column.key = std::move(name);
    if (column.unit != Unit::none) column.key.append("_").append(unit_suffix(column.unit));
    column.doc = doc;
    column.kind = type.kind == TypeKind::number ? ColumnKind::real
                  : type.kind == TypeKind::choice || type.kind == TypeKind::text
                      ? ColumnKind::word
                      : ColumnKind::integer;
    column.type_ = &type;
    column.steps_ = steps_;
    column.steps_.push_back({offset, nullptr});
    if (shown && type.kind == TypeKind::number) column.scale_ = unit_shown_per_stored(info.unit);
    columns_.push_back(std::move(column));
  }

  ColumnUnits units_;
  std::vector<Column::Step> steps_;
  std::vector<Column> columns_;
};

std::vector<Column> to_columns(const Type& row, ColumnUnits units, Unit unit) {
  ColumnLister lister(units);
  lister.list(row, FieldInfo(unit, "", ""), "", "");
  return lister.take();
}

const void* Column::in(const void* row) const {
  for (const Step& step : steps_) {
    row = static_cast<const std::byte*>(row) + step.offset;
    if (!step.optional) continue;
    if (step.optional->count(row) == 0) return nullptr;
    row = step.optional->find_part(row);
  }
  return row;
}

double Column::number(const void* row) const {
  const void* value = in(row);
  if (!value) return no_value;
  switch (type_->kind) {
    case TypeKind::boolean:
      return *static_cast<const bool*>(value);
    case TypeKind::integer:
      return *static_cast<const int*>(value);
    case TypeKind::index:
      return *static_cast<const std::uint32_t*>(value);
    case TypeKind::count:
      return static_cast<double>(*static_cast<const std::uint64_t*>(value));
    default:
      return *static_cast<const double*>(value) * scale_;
  }
}

std::int64_t Column::integer(const void* row) const {
  return in(row) ? static_cast<std::int64_t>(number(row)) : -1;
}

bool Column::set_integer(void* row, std::int64_t value) const {
  const bool can_miss = std::ranges::any_of(steps_, [](const Step& step) { return step.optional; });
  return (value == -1 && can_miss) || set_number(row, static_cast<double>(value));
}

bool Column::set_number(void* row, double value) const {
  if (kind == ColumnKind::integer && !(value >= 0 && value <= greatest_value(type_->kind)))
    return false;
  const bool missing = std::isnan(value);
  for (const Step& step : steps_) {
    row = static_cast<std::byte*>(row) + step.offset;
    if (!step.optional) continue;
    if (step.optional->count(row) == 0 && missing) return true;
    if (step.optional->count(row) == 0) step.optional->set_count(row, 1);
    row = step.optional->part(row, 0);
  }
  switch (type_->kind) {
    case TypeKind::boolean:
      *static_cast<bool*>(row) = value != 0;
      break;
    case TypeKind::integer:
      *static_cast<int*>(row) = static_cast<int>(value);
      break;
    case TypeKind::index:
      *static_cast<std::uint32_t*>(row) = static_cast<std::uint32_t>(value);
      break;
    case TypeKind::count:
      *static_cast<std::uint64_t*>(row) = static_cast<std::uint64_t>(value);
      break;
    default:
      *static_cast<double*>(row) = value / scale_;
  }
  return true;
}

std::string_view Column::word(const void* row) const {
  const void* value = in(row);
  if (!value) return {};
  if (type_->kind == TypeKind::text) return *static_cast<const std::string*>(value);
  return type_->words[type_->count(value)];
}

bool Column::set_word(void* row, std::string_view word) const {
  if (type_->kind == TypeKind::text) {
    *static_cast<std::string*>(const_cast<void*>(in(row))) = word;
    return true;
  }
  const auto found = std::ranges::find(type_->words, word);
  if (found == type_->words.end()) return false;
  void* value = const_cast<void*>(in(row));
  assert(value && "an optional word");
  type_->set_count(value, static_cast<std::size_t>(found - type_->words.begin()));
  return true;
}

std::string Column::text(const void* row) const {
  if (kind == ColumnKind::word) return std::string(word(row));
  const double value = number(row);
  return std::isnan(value) ? "" : number_text(value);
}

std::string csv_text(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + "\"";
}

std::string csv_head(const std::vector<Column>& columns) {
  std::string line;
  for (const Column& column : columns) line += (line.empty() ? "" : ",") + column.key;
  return line;
}

std::string csv_line(const std::vector<Column>& columns, const void* row) {
  std::string line;
  for (std::size_t i = 0; i < columns.size(); ++i)
    line.append(i ? "," : "").append(csv_text(columns[i].text(row)));
  return line;
}

}  // namespace microswarm::io
