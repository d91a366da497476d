// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/yaml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "microswarm/config/value_reader.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

YamlNode word_node(std::string_view word) {
  YamlNode node;
  node.kind = YamlNode::Kind::scalar;
  node.text = word;
  return node;
}

/// A walk along an assignment's key to the part that it sets.
struct Walk {
  const Type* type;
  FieldInfo info;
  std::string label;
  void* value;
  std::string key{};  ///< current key of that part
  const Setting& setting;
  const ValueReader& reader;

  [[noreturn]] void fail(const std::string& what) const {
    reader.fail({}, what, one_line(setting.value));
  }

  void enter_content() {
    while (type->kind == TypeKind::optional) {
      if (type->count(value) == 0) type->set_count(value, 1);
      value = type->part(value, 0);
      type = type->parts[0];
    }
  }

  void enter_entry(std::string_view word) {
    const std::size_t size = type->count(value);
    std::size_t i = size;
    const char* end = word.data() + word.size();
    if (std::from_chars(word.data(), end, i).ptr != end || i >= size)
      fail(fmt::format("{} has {} entries, counted from 0, and none is {}", label, size,
                       quote(word)));
    value = type->part(value, i);
    type = type->parts[0];
    key += word;
  }

  void enter_key(std::string_view word, bool has_type_key) {
    const Field* field = type->field(word);
    if (!field) field = type->former_field(word);
    if (!field)
      reader.fail_unknown_key(*type, word_node(word), one_line(setting.value), has_type_key);
    type = field->type;
    info = field->info;
    label = field->key;
    value = field->in(value);
    key += field->key;
  }

  /// Enters the part of that name or index.
  void enter(std::string_view word) {
    enter_content();
    switch (type->kind) {
      case TypeKind::variant: {
        const std::size_t chosen = type->count(value);
        value = type->part(value, 0);
        type = type->parts[chosen];
        return enter_key(word, true);
      }
      case TypeKind::record:
        return enter_key(word, false);
      case TypeKind::list:
        return enter_entry(word);
      default:
        fail(fmt::format("{} has no parts, so no {}", label, quote(word)));
    }
  }

  /// Enters the part that the path names, or the variant whose `type` it names: then true.
  bool enter_path(std::string_view path) {
    for (bool more = true; more;) {
      const std::size_t dot = path.find('.');
      const std::string_view word = path.substr(0, dot);
      more = dot != std::string_view::npos;
      if (more) path.remove_prefix(dot + 1);
      if (!more && word == "type") {
        enter_content();
        if (type->kind == TypeKind::variant) {
          key += word;
          return true;
        }
      }
      enter(word);
      if (more) key += '.';
    }
    return false;
  }
};

bool holds_text(const Type& type) {
  return type.kind == TypeKind::text ||
         (type.kind == TypeKind::optional && holds_text(*type.parts[0]));
}

YamlNode value_node(const Type& type, std::string_view text, std::string_view name) {
  const bool none = type.kind == TypeKind::optional && text == "null";
  if (!holds_text(type) || none) return parse_yaml(text, name);
  check_characters(text, name);
  return word_node(text);
}

/// Sets the part at `path`; returns the assignment with its current keys.
Setting assign(const Type& type, void* value, const Setting& setting, std::string_view path,
               const std::string& name, std::span<const MovedKey> moved, Notes& notes) {
  const ValueReader of_key(name, false, setting.key);
  Walk to{&type, {}, "", value, {}, setting, of_key};
  if (to.enter_path(path)) {
    const YamlNode chosen = parse_yaml(setting.value, name);
    if (chosen.text != to.type->words[to.type->count(to.value)])  // else it stays
      ValueReader(of_key).choose(*to.type, fmt::format("type of {}", to.label), to.value, chosen);
    return {to.key, setting.value};
  }
  YamlNode node = value_node(*to.type, setting.value, name);
  const bool renamed = use_present_keys_in_value(*to.type, node, name, to.key, moved, notes);
  ValueReader reader(name, false, to.key);
  reader.read(*to.type, to.info, to.label, to.value, node);
  if (!reader.issues().empty()) throw InputError(reader.issues());
  return {to.key, renamed ? flow_text(node) : setting.value};
}

}  // namespace

YamlNode read_yaml(const Type& type, void* value, std::string_view text, std::string_view name,
                   Issues& issues, Notes& notes, std::span<const MovedKey> moved) {
  YamlNode node = parse_yaml(text, name);
  if (node.line == 0) node.line = node.column = 1;  // an empty document
  use_present_keys(type, node, name, moved, notes);
  ValueReader reader(name, true);
  reader.read(type, {}, "", value, node);
  issues.add(reader.issues());
  return node;
}

YamlNode read_yaml(const Type& type, void* value, std::string_view text, std::string_view name,
                   std::span<const MovedKey> moved) {
  Issues issues;
  Notes notes;
  YamlNode node = read_yaml(type, value, text, name, issues, notes, moved);
  if (!issues.empty()) throw InputError(issues);
  return node;
}

std::optional<Setting> set_value(const Type& type, void* value, const Setting& setting,
                                 std::string_view option, std::span<const MovedKey> moved,
                                 Notes& notes) {
  const std::string name = setting_location(option, setting.key);
  std::string_view path = setting.key;
  if (const auto at = std::ranges::find(moved, path, &MovedKey::from); at != moved.end()) {
    if (at->to.empty()) {
      notes.push_back(name + ": has no meaning any more");
      return std::nullopt;
    }
    path = at->to;
  }
  try {
    Setting present = assign(type, value, setting, path, name, moved, notes);
    if (present.key != setting.key)
      notes.push_back(fmt::format("{}: is now '{}'", name, present.key));
    return present;
  } catch (const InputError& error) {
    Issues issues;
    for (Issue issue : error.issues()) {
      if (issue.keys.empty()) issue.value = one_line(setting.value);
      if (issue.keys.empty()) issue.keys.push_back(setting.key);
      issues.add(std::move(issue));
    }
    throw InputError(std::move(issues));
  }
}

std::vector<std::size_t> types_first(std::span<const Setting> settings) {
  constexpr std::string_view type_word = ".type";
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const std::string_view key = settings[i].key;
    auto to = order.end();
    if (key.ends_with(type_word)) {
      const std::string_view part = key.substr(0, key.size() - type_word.size());
      // Back to the first of its parts, but not across an assignment of the whole.
      for (auto at = order.end(); at != order.begin();) {
        const std::string_view other = settings[*--at].key;
        if (other == key || is_in_key(part, other)) break;
        if (is_in_key(other, part)) to = at;
      }
    }
    order.insert(to, i);
  }
  return order;
}

}  // namespace microswarm
