// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "microswarm/config/number.hpp"
#include "microswarm/config/write.hpp"

namespace microswarm {
namespace {

constexpr std::size_t columns = 5;
constexpr std::size_t longest_default = 24;
using Row = std::array<std::string, columns>;

bool has_parts(const Type& type) {
  return type.kind == TypeKind::record || type.kind == TypeKind::variant;
}

const Type& content_of(const Type& type) {
  const bool wraps = type.kind == TypeKind::optional || type.kind == TypeKind::list;
  return wraps ? content_of(*type.parts[0]) : type;
}

std::string default_text(const Field& field, const void* value) {
  if (field.info.required) return "required";
  const Type& type = *field.type;
  if (type.kind == TypeKind::record) return "";
  if (type.kind == TypeKind::variant) return std::string(type.words[type.count(value)]);
  if (type.kind == TypeKind::optional && type.count(value) == 0) return "none";
  std::string text = yaml_line(type, field.info.unit, value);
  if (type.kind == TypeKind::list && text.size() > longest_default)
    return fmt::format("{} entries", type.count(value));
  return text;
}

std::string allowed_text(const Field& field) {
  const Type& type = content_of(*field.type);
  if (type.kind == TypeKind::variant) return "a type below";
  if (type.kind == TypeKind::choice) return fmt::format("{}", fmt::join(type.words, " | "));
  if (type.kind == TypeKind::boolean) return "true | false";
  return range_text(field.info.range, Unit::none);
}

void add_parts(const Type& type, const void* defaults, std::size_t depth, std::vector<Row>& rows);

void add_field(const Field& field, const void* value, std::size_t depth, std::vector<Row>& rows) {
  rows.push_back({std::string(2 * depth, ' ') + field.key,
                  std::string(unit_symbol(field.info.unit)), default_text(field, value),
                  allowed_text(field), std::string(field.info.doc)});
  const Type& content = content_of(*field.type);
  if (has_parts(content))
    add_parts(content, &content == field.type ? value : content.defaults, depth + 1, rows);
}

void add_parts(const Type& type, const void* defaults, std::size_t depth, std::vector<Row>& rows) {
  for (const Field& field : type.fields) add_field(field, field.in(defaults), depth, rows);
  for (std::size_t i = 0; i < type.parts.size(); ++i) {
    rows.push_back({fmt::format("{:{}}type: {}", "", 2 * depth, type.words[i])});
    add_parts(*type.parts[i], type.parts[i]->defaults, depth + 1, rows);
  }
}

/// Width on a terminal: bytes that do not continue a UTF-8 character.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

}  // namespace

std::string help_text(const Type& type) {
  std::vector<Row> rows = {{"key", "unit", "default", "allowed", "meaning"}};
  add_parts(type, type.defaults, 0, rows);
  std::array<std::size_t, columns> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < columns; ++i) widths[i] = std::max(widths[i], width(row[i]));

  std::string table;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < columns; ++i) {
      line += row[i];
      line.append(widths[i] - width(row[i]) + 2, ' ');
    }
    table += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return table;
}

}  // namespace microswarm
