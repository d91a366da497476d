// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/key_locations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <utility>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/text/text.hpp"

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

struct Document {
  YamlNode root;
  std::string name;
  Settings assignments;  // last one first

  std::optional<std::string> operator()(std::string_view key, KeyLocations::Seek seek) const {
    const bool itself = seek == KeyLocations::Seek::itself;
    for (const auto& [path, value] : assignments.list) {
      const bool found = sets(path, value, key);
      if (itself && found && path != key) {
        const Change change = find_change(path, value, key);
        if (change == Change::dropped) return std::nullopt;
        if (change == Change::none) continue;
      }
      if (found || (seek == KeyLocations::Seek::all_of_it && is_in_key(path, key)))
        return setting_location(assignments.option, path);
    }
    const YamlNode* node = node_at(root, key);
    if (!node) return std::nullopt;
    return fmt::format("{}:{}:{}", name, node->line, node->column);
  }

  enum class Change { none, written, dropped };

  /// Effect on a key of an assignment to something that contains it: a map may hold the key, and a
  /// map with a type drops the keys it does not hold.
  static Change find_change(std::string_view path, std::string_view value, std::string_view key) {
    if (!key.starts_with(path)) return Change::dropped;  // by a type
    const YamlNode node = parse_yaml(value, path);
    if (node_at(node, key.substr(path.size() + 1))) return Change::written;
    return node.kind == YamlNode::Kind::map && !child(node, "type") ? Change::none
                                                                    : Change::dropped;
  }

  /// Choosing a type other than the document's resets all keys beside it.
  bool sets(std::string_view path, std::string_view value, std::string_view key) const {
    if (is_in_key(key, path)) return true;
    constexpr std::string_view type = ".type";
    if (!path.ends_with(type) || !is_in_key(key, path.substr(0, path.size() - type.size())))
      return false;
    const YamlNode* node = node_at(root, path);
    return !node || node->text != value;
  }
};

}  // namespace

bool KeyLocations::given(std::string_view key) const { return find_ && find_(key, Seek::itself); }

IsGiven KeyLocations::is_given() const {
  return [keys = *this](std::string_view key) { return keys.given(key); };
}

std::string KeyLocations::locate(const std::vector<std::string>& keys) const {
  if (!find_) return name_;
  for (const std::string& key : keys)
    if (const auto location = find_(key, Seek::all_of_it)) return *location;
  std::string key = keys.front();
  for (std::size_t dot = key.rfind('.'); dot != std::string::npos; dot = key.rfind('.')) {
    key.resize(dot);
    if (const auto location = find_(key, Seek::missing_in_it)) return *location;
  }
  return name_;
}

Issue KeyLocations::located(Issue issue) const {
  if (!issue.keys.empty() && issue.location.empty()) issue.location = locate(issue.keys);
  return issue;
}

Issues KeyLocations::located(const Issues& issues) const {
  Issues all;
  for (const Issue& issue : issues) all.add(located(issue));
  return all;
}

void KeyLocations::require_none(const Issues& issues) const {
  if (!issues.empty()) throw InputError(located(issues));
}

InputError KeyLocations::error(std::string_view key, const std::string& what) const {
  return InputError(located(Issue{{std::string(key)}, what}));
}

KeyLocations find_locations(YamlNode document, const std::string& name, Settings assignments,
                            Notes notes) {
  std::ranges::reverse(assignments.list);
  const auto found =
      std::make_shared<const Document>(Document{std::move(document), name, std::move(assignments)});
  return {name,
          [found](std::string_view key, KeyLocations::Seek seek) { return (*found)(key, seek); },
          std::move(notes)};
}

}  // namespace microswarm
