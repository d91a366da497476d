// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/yaml_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <utility>

#include "microswarm/core/text.hpp"

namespace microswarm {
namespace {

const YamlNode* child(const YamlNode& node, std::string_view word) {
  if (node.kind == YamlNode::Kind::map) {
    for (std::size_t i = 0; i < node.items.size(); i += 2)
      if (node.items[i].text == word) return &node.items[i + 1];
  } else if (node.kind == YamlNode::Kind::list) {
    std::size_t i = node.items.size();
    const char* end = word.data() + word.size();
    if (std::from_chars(word.data(), end, i).ptr == end && i < node.items.size())
      return &node.items[i];
  }
  return nullptr;
}

const YamlNode* node_at(const YamlNode& document, std::string_view key) {
  const YamlNode* node = &document;
  for (bool more = true; more && node;) {
    const std::size_t dot = key.find('.');
    more = dot != std::string_view::npos;
    node = child(*node, key.substr(0, dot));
    if (more) key.remove_prefix(dot + 1);
  }
  return node;
}

bool is_or_holds(std::string_view outer, std::string_view key) {
  return key.starts_with(outer) && (key.size() == outer.size() || key[outer.size()] == '.');
}

struct Document {
  YamlNode root;
  std::string name;
  Settings assignments;  // the last one first

  std::optional<std::string> operator()(std::string_view key, Places::Seek seek) const {
    const bool itself = seek == Places::Seek::itself;
    for (const std::string_view assignment : assignments.texts) {
      const std::string_view path = assignment.substr(0, assignment.find('='));
      const bool found = sets(path, assignment.substr(path.size() + 1), key);
      if (itself && found && path != key) {
        const Change change = change_of(path, assignment, key);
        if (change == Change::dropped) return std::nullopt;
        if (change == Change::none) continue;
      }
      if (found || (seek == Places::Seek::all_of_it && is_or_holds(key, path)))
        return fmt::format("{} {}", assignments.option, one_line(path));
    }
    const YamlNode* node = node_at(root, key);
    if (!node) return std::nullopt;
    return fmt::format("{}:{}:{}", name, node->line, node->column);
  }

  enum class Change { none, written, dropped };

  /// What an assignment to something that the key is in does to the key: a map may hold it, and a
  /// map with a type drops what it does not hold.
  static Change change_of(std::string_view path, std::string_view assignment,
                          std::string_view key) {
    if (!key.starts_with(path)) return Change::dropped;  // by a type
    const YamlNode value = parse_yaml(assignment.substr(path.size() + 1), path);
    if (node_at(value, key.substr(path.size() + 1))) return Change::written;
    return value.kind == YamlNode::Kind::map && !child(value, "type") ? Change::none
                                                                      : Change::dropped;
  }

  /// A type that is another than the document's brings all keys beside it anew.
  bool sets(std::string_view path, std::string_view value, std::string_view key) const {
    if (is_or_holds(path, key)) return true;
    constexpr std::string_view type = ".type";
    if (!path.ends_with(type) || !is_or_holds(path.substr(0, path.size() - type.size()), key))
      return false;
    const YamlNode* node = node_at(root, path);
    return !node || node->text != value;
  }
};

}  // namespace

Places places_of(YamlNode document, const std::string& name, Settings assignments) {
  std::reverse(assignments.texts.begin(), assignments.texts.end());
  const auto found =
      std::make_shared<const Document>(Document{std::move(document), name, std::move(assignments)});
  return {name, [found](std::string_view key, Places::Seek seek) { return (*found)(key, seek); }};
}

}  // namespace microswarm
