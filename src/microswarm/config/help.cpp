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

const Type& content_type(const Type& type) {
  const bool wraps = type.kind == TypeKind::optional || type.kind == TypeKind::list;
  return wraps ? content_type(*type.parts[0]) : type;
}

std::vector<KeyHelp> list_keys(const Type& type, const void* defaults);

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

void add_parts(const Type& type, const void* defaults, KeyHelp& to) {
  to.keys = list_keys(type, defaults);
  for (std::size_t i = 0; i < type.parts.size(); ++i) {
    const Type& part = *type.parts[i];
    to.types.push_back({.key = std::string(type.words[i]), .keys = list_keys(part, part.defaults)});
  }
}

KeyHelp to_help(const Field& field, const void* value) {
  const Type& content = content_type(*field.type);
  KeyHelp help{.key = field.key,
               .unit = unit_symbol(field.info.unit),
               .default_text = default_text(field, value),
               .range = range_text(field.info.range, Unit::none),
               .doc = field.info.doc};
  if (content.kind == TypeKind::choice) help.words = content.words;
  if (content.kind == TypeKind::boolean) help.words = {"true", "false"};
  if (has_parts(content))
    add_parts(content, &content == field.type ? value : content.defaults, help);
  return help;
}

std::vector<KeyHelp> list_keys(const Type& type, const void* defaults) {
  std::vector<KeyHelp> keys;
  for (const Field& field : type.fields) keys.push_back(to_help(field, field.in(defaults)));
  return keys;
}

std::string allowed_text(const KeyHelp& key) {
  if (!key.types.empty()) return "a type below";
  return key.words.empty() ? key.range : fmt::format("{}", fmt::join(key.words, " | "));
}

void add_rows(const std::vector<KeyHelp>& keys, std::size_t depth, std::vector<Row>& rows) {
  const std::string indent(2 * depth, ' ');
  for (const KeyHelp& key : keys) {
    rows.push_back({indent + key.key, std::string(key.unit), key.default_text, allowed_text(key),
                    std::string(key.doc)});
    add_rows(key.keys, depth + 1, rows);
    for (const KeyHelp& type : key.types) {
      rows.push_back({fmt::format("{}  type: {}", indent, type.key)});
      add_rows(type.keys, depth + 2, rows);
    }
  }
}

/// Width on a terminal: bytes that do not continue a UTF-8 character.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

}  // namespace

std::vector<KeyHelp> key_help(const Type& type) { return list_keys(type, type.defaults); }

std::string help_text(const Type& type) {
  std::vector<Row> rows = {{"key", "unit", "default", "allowed", "meaning"}};
  add_rows(key_help(type), 0, rows);
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
