// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/former_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "microswarm/config/type.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm {
namespace {

using Kind = YamlNode::Kind;

/// Index of a key's value in the map's items; nothing if the key is absent.
std::optional<std::size_t> find_value(const YamlNode& map, std::string_view key) {
  if (map.kind != Kind::map) return std::nullopt;
  for (std::size_t i = 0; i < map.items.size(); i += 2)
    if (map.items[i].text == key) return i + 1;
  return std::nullopt;
}

struct Renaming {
  std::string_view name;  ///< of the document or the assignment
  bool has_lines;
  Notes& notes;

  void note(const YamlNode& key, const std::string& what) const {
    notes.push_back(has_lines ? fmt::format("{}:{}:{}: {}", name, key.line, key.column, what)
                              : fmt::format("{}: {}", name, what));
  }
  void note(const YamlNode& key, std::string_view from, std::string_view to) const {
    note(key, fmt::format("'{}' is now '{}'", from, to));
  }

  /// Drops a key that no longer has a meaning.
  void retire(std::vector<YamlNode>& part, std::size_t value, std::string_view from) const {
    const auto at = part.begin() + static_cast<std::ptrdiff_t>(value);
    note(*(at - 1), fmt::format("'{}' has no meaning any more", from));
    part.erase(at - 1, at + 1);
  }

  /// Drops it wherever the parts of its name lead to.
  void retire(YamlNode& part, std::string_view path, std::string_view from) const {
    const std::size_t dot = path.find('.');
    const auto value = find_value(part, path.substr(0, dot));
    if (!value) return;
    if (dot == std::string_view::npos) return retire(part.items, *value, from);
    retire(part.items[*value], path.substr(dot + 1), from);
  }

  /// Takes a key of a part of the document to another part.
  void move(YamlNode& document, const MovedKey& moved) const {
    if (moved.to.empty()) return retire(document, moved.from, moved.from);
    const std::size_t from = moved.from.find('.'), to = moved.to.find('.');
    const auto source = find_value(document, moved.from.substr(0, from));
    if (!source) return;
    const auto value = find_value(document.items[*source], moved.from.substr(from + 1));
    if (!value) return;
    auto target = find_value(document, moved.to.substr(0, to));
    if (target) {
      const YamlNode& part = document.items[*target];
      const bool is_map = part.kind == Kind::map || part.kind == Kind::null;
      if (!is_map || find_value(part, moved.to.substr(to + 1))) return;
    }
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
        if (!field || find_value(node, field->key)) continue;
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
        const auto chosen = find_value(node, "type");
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

}  // namespace

void use_present_keys(const Type& type, YamlNode& document, std::string_view name,
                      std::span<const MovedKey> moved, Notes& notes) {
  const Renaming renaming{name, true, notes};
  for (const MovedKey& one : moved) renaming.move(document, one);
  renaming.rename(type, document);
}

bool use_present_keys_in_value(const Type& type, YamlNode& value, std::string_view name,
                               std::string_view key, std::span<const MovedKey> moved,
                               Notes& notes) {
  const std::size_t before = notes.size();
  const Renaming renaming{name, false, notes};
  for (const MovedKey& one : moved) {
    if (!one.from.starts_with(key) || !one.from.substr(key.size()).starts_with('.')) continue;
    const std::string_view inside = one.from.substr(key.size() + 1);
    if (one.to.empty())
      renaming.retire(value, inside, one.from);
    else if (find_value(value, inside))
      throw InputError(std::string(name), 0, 0,
                       fmt::format("'{}' is now '{}': set that", one.from, one.to));
  }
  renaming.rename(type, value);
  return notes.size() > before;
}

}  // namespace microswarm
