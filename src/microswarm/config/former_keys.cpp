// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/former_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "microswarm/config/type.hpp"
#include "microswarm/core/text.hpp"

namespace microswarm {
namespace {

using Kind = YamlNode::Kind;

/// Index of a key's value in the map's items; nothing if the key is absent.
std::optional<std::size_t> value_of(const YamlNode& map, std::string_view key) {
  if (map.kind != Kind::map) return std::nullopt;
  for (std::size_t i = 0; i < map.items.size(); i += 2)
    if (map.items[i].text == key) return i + 1;
  return std::nullopt;
}

struct Renaming {
  std::string_view name;  ///< of the document
  Notes& notes;

  void note(const YamlNode& key, std::string_view from, std::string_view to) const {
    notes.push_back(
        fmt::format("{}:{}:{}: '{}' is now '{}'", name, key.line, key.column, from, to));
  }

  /// Drops a key that no longer has a meaning.
  void retire(std::vector<YamlNode>& part, std::size_t value, std::string_view from) const {
    const auto at = part.begin() + static_cast<std::ptrdiff_t>(value);
    const YamlNode& key = *(at - 1);
    notes.push_back(
        fmt::format("{}:{}:{}: '{}' has no meaning any more", name, key.line, key.column, from));
    part.erase(at - 1, at + 1);
  }

  /// Takes a key of a part of the document to another part.
  void move(YamlNode& document, const MovedKey& moved) const {
    const std::size_t from = moved.from.find('.'), to = moved.to.find('.');
    const auto source = value_of(document, moved.from.substr(0, from));
    if (!source) return;
    const auto value = value_of(document.items[*source], moved.from.substr(from + 1));
    if (!value) return;
    if (moved.to.empty()) return retire(document.items[*source].items, *value, moved.from);
    auto target = value_of(document, moved.to.substr(0, to));
    if (target && value_of(document.items[*target], moved.to.substr(to + 1))) return;
    if (!target) {
      YamlNode part = document.items[*source], word;
      part.items.clear();
      part.kind = Kind::map;
      word.kind = Kind::scalar;
      word.text = moved.to.substr(0, to);
      document.items.push_back(std::move(word));
      document.items.push_back(std::move(part));
      target = document.items.size() - 1;
    }
    std::vector<YamlNode>& here = document.items[*source].items;
    const auto at = here.begin() + static_cast<std::ptrdiff_t>(*value) - 1;
    YamlNode key = at[0], what = at[1];
    note(key, moved.from, moved.to);
    here.erase(at, at + 2);
    key.text = moved.to.substr(to + 1);
    YamlNode& there = document.items[*target];
    there.kind = Kind::map;
    there.items.push_back(std::move(key));
    there.items.push_back(std::move(what));
  }

  void rename_in_record(const Type& type, YamlNode& node) const {
    if (node.kind != Kind::map) return;
    for (std::size_t i = 0; i < node.items.size(); i += 2) {
      YamlNode& key = node.items[i];
      const Field* field = type.field(key.text);
      if (!field) {
        field = type.former_field(key.text);
        if (!field || value_of(node, field->key)) continue;
        note(key, key.text, field->key);
        key.text = field->key;
      }
      rename(*field->type, node.items[i + 1]);
    }
  }

  void rename(const Type& type, YamlNode& node) const {
    switch (type.kind) {
      case TypeKind::record:
        return rename_in_record(type, node);
      case TypeKind::optional:
        return rename(*type.parts[0], node);
      case TypeKind::list:
        if (node.kind == Kind::list)
          for (YamlNode& item : node.items) rename(*type.parts[0], item);
        return;
      case TypeKind::variant: {
        const auto chosen = value_of(node, "type");
        if (!chosen) return;
        const auto word = std::ranges::find(type.words, node.items[*chosen].text);
        if (word != type.words.end())
          rename_in_record(*type.parts[static_cast<std::size_t>(word - type.words.begin())], node);
        return;
      }
      default:
        return;
    }
  }
};

/// Enters the content of optionals and the current alternative of variants; null if the optional is
/// empty.
const Type* held_type(const Type* type, const void*& value) {
  while (type->kind == TypeKind::optional || type->kind == TypeKind::variant) {
    const std::size_t count = type->count(value);
    const bool is_optional = type->kind == TypeKind::optional;
    if (is_optional && count == 0) return nullptr;
    const Type* held = type->parts[is_optional ? 0 : count];
    value = type->part_of(value);
    type = held;
  }
  return type;
}

}  // namespace

void use_present_keys(const Type& type, YamlNode& document, std::string_view name,
                      std::span<const MovedKey> moved, Notes& notes) {
  const Renaming renaming{name, notes};
  for (const MovedKey& one : moved) renaming.move(document, one);
  renaming.rename(type, document);
}

std::string with_present_key(const Type& of, const void* value, std::string_view assignment,
                             std::span<const MovedKey> moved) {
  std::string_view path = assignment.substr(0, assignment.find('='));
  const std::string_view rest = assignment.substr(path.size());
  for (const MovedKey& one : moved)
    if (path == one.from && !one.to.empty()) return fmt::format("{}{}", one.to, rest);
  std::string present;
  const Type* type = &of;
  for (bool more = true; more;) {
    const std::string_view word = path.substr(0, path.find('.'));
    more = word.size() < path.size();
    std::string_view now = word;
    if (type) type = held_type(type, value);
    if (type && type->kind == TypeKind::record) {
      const Field* field = type->field(word);
      if (!field) field = type->former_field(word);
      type = field ? field->type : nullptr;
      if (field) {
        now = field->key;
        value = field->in(value);
      }
    } else if (type && type->kind == TypeKind::list) {
      std::size_t i = type->count(value);
      std::from_chars(word.data(), word.data() + word.size(), i);
      const bool is_entry = i < type->count(value);
      if (is_entry) value = type->part_of(value, i);
      type = is_entry ? type->parts[0] : nullptr;
    } else {
      type = nullptr;
    }
    present += now;
    path.remove_prefix(word.size() + (more ? 1 : 0));
    if (more) present += '.';
  }
  return present + std::string(rest);
}

std::string renaming_note(std::string_view option, std::string_view assignment,
                          std::string_view present) {
  const std::string_view now = present.substr(0, present.find('='));
  return fmt::format("{} {}: is now '{}'", option,
                     one_line(assignment.substr(0, assignment.find('='))), now);
}

}  // namespace microswarm
