// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/yaml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "microswarm/config/value_reader.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

/// Current position within an assignment's path.
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
  if (!field) field = place.type->former_field(word.text);
  if (!field) reader.fail_unknown_key(*place.type, word);
  place = {field->type, field->info, field->key, field->in(place.value)};
}

/// Enters the part of that name or index; returns its current name.
std::string enter(Place& place, std::string_view word, const ValueReader& reader) {
  const YamlNode node = word_node(word);
  enter_content(place);
  switch (place.type->kind) {
    case TypeKind::variant:
      place = {place.type->parts[place.type->count(place.value)], place.info, place.label,
               place.type->part(place.value, 0)};
      [[fallthrough]];
    case TypeKind::record:
      enter_key(place, node, reader);
      return place.label;
    case TypeKind::list:
      enter_entry(place, node, reader);
      return std::string(word);
    default:
      reader.fail(node, fmt::format("{} has no parts, so no {}", place.label, quote(word)));
  }
}

bool holds_text(const Type& type) {
  return type.kind == TypeKind::text ||
         (type.kind == TypeKind::optional && holds_text(*type.parts[0]));
}

/// The value on one line, as it may stand in an assignment.
std::string flow_text(const YamlNode& node) {
  std::vector<std::string> items;
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "null";
    case YamlNode::Kind::scalar:
      return node.quoted ? nlohmann::json(node.text).dump() : node.text;
    case YamlNode::Kind::list:
      for (const YamlNode& item : node.items) items.push_back(flow_text(item));
      return fmt::format("[{}]", fmt::join(items, ", "));
    case YamlNode::Kind::map:
      for (std::size_t i = 0; i < node.items.size(); i += 2)
        items.push_back(flow_text(node.items[i]) + ": " + flow_text(node.items[i + 1]));
      return fmt::format("{{{}}}", fmt::join(items, ", "));
  }
  return "";
}

YamlNode value_node(const Type& type, std::string_view text, std::string_view name) {
  const bool none = type.kind == TypeKind::optional && text == "null";
  if (!holds_text(type) || none) return parse_yaml(text, name);
  check_characters(text, name);
  return word_node(text);
}

}  // namespace

YamlNode read_yaml(const Type& type, void* value, std::string_view text, std::string_view name,
                   Mistakes& mistakes, Notes& notes, std::span<const MovedKey> moved) {
  YamlNode node = parse_yaml(text, name);
  if (node.line == 0) node.line = node.column = 1;  // an empty document
  use_present_keys(type, node, name, moved, notes);
  ValueReader reader(name, true);
  reader.read(type, {}, "", value, node);
  mistakes = reader.mistakes();
  return node;
}

YamlNode read_yaml(const Type& type, void* value, std::string_view text, std::string_view name,
                   std::span<const MovedKey> moved) {
  Mistakes mistakes;
  Notes notes;
  YamlNode node = read_yaml(type, value, text, name, mistakes, notes, moved);
  mistakes.require_none();
  return node;
}

std::optional<std::string> set_value(const Type& type, void* value, std::string_view assignment,
                                     std::string_view option, std::span<const MovedKey> moved,
                                     Notes& notes) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw InputError(fmt::format("{} {}: must be KEY=VALUE", option, quote(assignment)));
  const std::string_view given = assignment.substr(0, equals);
  std::string_view path = given;
  std::string text(assignment.substr(equals + 1));
  const std::string name = fmt::format("{} {}", option, one_line(path));
  if (const auto at = std::ranges::find(moved, path, &MovedKey::from); at != moved.end()) {
    if (at->to.empty()) {
      notes.push_back(name + ": has no meaning any more");
      return std::nullopt;
    }
    path = at->to;
  }
  ValueReader reader(name, false);

  Place place{&type, {}, "", value};
  std::string key;
  const auto present = [&] {
    if (key != given) notes.push_back(fmt::format("{}: is now '{}'", name, key));
    return key + "=" + text;
  };
  for (bool more = true; more;) {
    const std::size_t dot = path.find('.');
    const std::string_view word = path.substr(0, dot);
    more = dot != std::string_view::npos;
    if (more) path.remove_prefix(dot + 1);
    if (!more && word == "type") {
      enter_content(place);
      if (place.type->kind == TypeKind::variant) {
        const YamlNode chosen = parse_yaml(text, name);
        key += "type";
        if (chosen.text != place.type->words[place.type->count(place.value)])  // else it stays
          reader.choose(*place.type, fmt::format("type of {}", place.label), place.value, chosen);
        return present();
      }
    }
    key += enter(place, word, reader) + (more ? "." : "");
  }
  YamlNode node = value_node(*place.type, text, name);
  if (use_present_keys_in_value(*place.type, node, name, key, moved, notes)) text = flow_text(node);
  reader.read(*place.type, place.info, place.label, place.value, node);
  reader.mistakes().require_none();
  return present();
}

void check_types_first(const Settings& given) {
  const std::vector<std::string>& assignments = given.texts;
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    const std::string key = assignments[i].substr(0, assignments[i].find('='));
    if (!key.ends_with(".type")) continue;
    const std::string part = key.substr(0, key.size() - 4);  // including the dot
    for (std::size_t k = 0; k < i; ++k)
      if (assignments[k].starts_with(part) && !assignments[k].starts_with(key + "="))
        throw InputError(fmt::format("{} {}: comes after {}, which it may drop: give it first",
                                     given.option, key, quote(assignments[k])));
  }
}

}  // namespace microswarm
