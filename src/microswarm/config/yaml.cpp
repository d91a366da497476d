// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/yaml.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "microswarm/config/value_reader.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/core/text.hpp"

namespace microswarm {
namespace {

/// Where an assignment's path has come to.
struct Place {
  const Type* type;
  FieldInfo info;
  std::string label;
  void* value;
};

YamlNode word_node(std::string_view word) {
  YamlNode node;
  node.kind = YamlNode::Kind::scalar;
  node.text = word;
  return node;
}

void enter_content(Place& place) {
  while (place.type->kind == TypeKind::optional) {
    if (place.type->count(place.value) == 0) place.type->set_count(place.value, 1);
    place = {place.type->parts[0], place.info, place.label, place.type->part(place.value, 0)};
  }
}

void enter_entry(Place& place, const YamlNode& word, const ValueReader& reader) {
  const std::size_t size = place.type->count(place.value);
  std::size_t i = size;
  const char* end = word.text.data() + word.text.size();
  if (std::from_chars(word.text.data(), end, i).ptr != end || i >= size)
    reader.fail(word, fmt::format("{} has {} entries, counted from 0, and none is {}", place.label,
                                  size, quote(word.text)));
  place = {place.type->parts[0], place.info, place.label, place.type->part(place.value, i)};
}

void enter_key(Place& place, const YamlNode& word, const ValueReader& reader) {
  const Field* field = place.type->field(word.text);
  if (!field) reader.fail_unknown_key(*place.type, word);
  place = {field->type, field->info, field->key, field->in(place.value)};
}

void enter(Place& place, std::string_view word, const ValueReader& reader) {
  const YamlNode node = word_node(word);
  enter_content(place);
  switch (place.type->kind) {
    case TypeKind::variant:
      place = {place.type->parts[place.type->count(place.value)], place.info, place.label,
               place.type->part(place.value, 0)};
      [[fallthrough]];
    case TypeKind::record:
      return enter_key(place, node, reader);
    case TypeKind::list:
      return enter_entry(place, node, reader);
    default:
      reader.fail(node, fmt::format("{} has no parts, so no {}", place.label, quote(word)));
  }
}

bool holds_text(const Type& type) {
  return type.kind == TypeKind::text ||
         (type.kind == TypeKind::optional && holds_text(*type.parts[0]));
}

/// The value of a map's key, as an index into its items; none where it has no such key.
std::optional<std::size_t> value_of(const YamlNode& map, std::string_view key) {
  if (map.kind != YamlNode::Kind::map) return std::nullopt;
  for (std::size_t i = 0; i < map.items.size(); i += 2)
    if (map.items[i].text == key) return i + 1;
  return std::nullopt;
}

/// Takes a key of a part of the document to another part, with its line. Where it is given there
/// too it stays, and is an unknown key. A key that is gone is removed.
void move_key(YamlNode& document, const MovedKey& moved) {
  const std::size_t from = moved.from.find('.'), to = moved.to.find('.');
  const auto source = value_of(document, moved.from.substr(0, from));
  if (!source) return;
  const auto value = value_of(document.items[*source], moved.from.substr(from + 1));
  if (!value) return;
  if (moved.to.empty()) {
    std::vector<YamlNode>& part = document.items[*source].items;
    const auto at = part.begin() + static_cast<std::ptrdiff_t>(*value);
    part.erase(at - 1, at + 1);
    return;
  }
  auto target = value_of(document, moved.to.substr(0, to));
  if (target && value_of(document.items[*target], moved.to.substr(to + 1))) return;
  if (!target) {
    YamlNode part = document.items[*source];
    part.items.clear();
    part.kind = YamlNode::Kind::map;
    YamlNode word = word_node(moved.to.substr(0, to));
    document.items.push_back(std::move(word));
    document.items.push_back(std::move(part));
    target = document.items.size() - 1;
  }
  std::vector<YamlNode>& here = document.items[*source].items;
  const auto at = here.begin() + static_cast<std::ptrdiff_t>(*value) - 1;
  YamlNode key = at[0], what = at[1];
  here.erase(at, at + 2);
  key.text = moved.to.substr(to + 1);
  YamlNode& there = document.items[*target];
  there.kind = YamlNode::Kind::map;
  there.items.push_back(std::move(key));
  there.items.push_back(std::move(what));
}

YamlNode value_node(const Type& type, std::string_view text, std::string_view name) {
  const bool none = type.kind == TypeKind::optional && text == "null";
  if (!holds_text(type) || none) return parse_yaml(text, name);
  check_characters(text, name);
  return word_node(text);
}

}  // namespace

std::string current_key(std::string_view assignment, std::span<const MovedKey> moved) {
  const std::string_view key = assignment.substr(0, assignment.find('='));
  for (const MovedKey& one : moved)
    if (key == one.from && !one.to.empty())
      return std::string(one.to) + std::string(assignment.substr(key.size()));
  return std::string(assignment);
}

YamlNode read_yaml(const Type& type, void* value, std::string_view text, std::string_view name,
                   Mistakes& mistakes, std::span<const MovedKey> moved) {
  YamlNode node = parse_yaml(text, name);
  if (node.line == 0) node.line = node.column = 1;  // an empty document
  for (const MovedKey& one : moved) move_key(node, one);
  ValueReader reader(name, true);
  reader.read(type, {}, "", value, node);
  mistakes = reader.mistakes();
  return node;
}

YamlNode read_yaml(const Type& type, void* value, std::string_view text, std::string_view name,
                   std::span<const MovedKey> moved) {
  Mistakes mistakes;
  YamlNode node = read_yaml(type, value, text, name, mistakes, moved);
  mistakes.require_none();
  return node;
}

void set_value(const Type& type, void* value, std::string_view assignment,
               std::string_view option) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw InputError(fmt::format("{} {}: must be KEY=VALUE", option, quote(assignment)));
  std::string_view path = assignment.substr(0, equals);
  const std::string_view text = assignment.substr(equals + 1);
  const std::string name = fmt::format("{} {}", option, one_line(path));
  ValueReader reader(name, false);

  Place place{&type, {}, "", value};
  for (bool more = true; more;) {
    const std::size_t dot = path.find('.');
    const std::string_view word = path.substr(0, dot);
    more = dot != std::string_view::npos;
    if (more) path.remove_prefix(dot + 1);
    if (!more && word == "type") {
      enter_content(place);
      if (place.type->kind == TypeKind::variant) {
        const YamlNode chosen = parse_yaml(text, name);
        const std::size_t held = place.type->count(place.value);
        if (chosen.text == place.type->words[held]) return;  // its settings stay
        return reader.choose(*place.type, fmt::format("type of {}", place.label), place.value,
                             chosen);
      }
    }
    enter(place, word, reader);
  }
  reader.read(*place.type, place.info, place.label, place.value,
              value_node(*place.type, text, name));
  reader.mistakes().require_none();
}

void check_types_first(const Settings& given) {
  const std::vector<std::string>& assignments = given.texts;
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    const std::string key = assignments[i].substr(0, assignments[i].find('='));
    if (!key.ends_with(".type")) continue;
    const std::string part = key.substr(0, key.size() - 4);  // with the dot
    for (std::size_t k = 0; k < i; ++k)
      if (assignments[k].starts_with(part) && !assignments[k].starts_with(key + "="))
        throw InputError(fmt::format("{} {}: comes after {}, which it may drop: give it first",
                                     given.option, key, quote(assignments[k])));
  }
}

}  // namespace microswarm
