// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/yaml_edit.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm {
namespace {

/// Offset of a line and column, both from 1.
std::optional<std::size_t> offset_of(std::string_view text, int line, int column) {
  std::size_t at = 0;
  for (int i = 1; i < line; ++i) {
    at = text.find('\n', at);
    if (at == std::string_view::npos) return std::nullopt;
    ++at;
  }
  at += static_cast<std::size_t>(column - 1);
  return at <= text.size() ? std::optional(at) : std::nullopt;
}

const YamlNode* find_in(const YamlNode& map, std::string_view key) {
  for (std::size_t i = 0; i + 1 < map.items.size(); i += 2)
    if (map.items[i].text == key) return &map.items[i + 1];
  return nullptr;
}

/// The brace that closes the one at `open`.
std::optional<std::size_t> closing(std::string_view text, std::size_t open) {
  int depth = 0;
  char quote = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == '\\' && quote == '"') ++i;
      if (c == quote) quote = 0;
    } else if (c == '#' && (text[i - 1] == ' ' || text[i - 1] == '\n')) {
      i = std::min(text.find('\n', i), text.size());
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if ((c == '}' || c == ']') && --depth == 0) {
      return i;
    }
  }
  return std::nullopt;
}

int last_line(const YamlNode& node) {
  int line = node.line;
  for (const YamlNode& item : node.items) line = std::max(line, last_line(item));
  return line;
}

/// Adds "key: value" to a map; false if its form is not one of the known.
bool add_to(std::string& text, const YamlNode& map, const std::string& entry) {
  const auto at = offset_of(text, map.line, map.column);
  if (!at) return false;
  if (*at < text.size() && text[*at] == '{') {
    const auto end = closing(text, *at);
    if (!end) return false;
    std::size_t behind = *end;
    while (behind > *at + 1 && (text[behind - 1] == ' ' || text[behind - 1] == '\n')) --behind;
    text.insert(behind, (map.items.empty() ? "" : ", ") + entry);
    return true;
  }
  if (map.items.empty()) return false;
  const std::string indent(static_cast<std::size_t>(map.items.front().column - 1), ' ');
  std::size_t end = 0;  // behind the last line of the map, and of a flow collection in it
  const YamlNode& last = map.items.back();
  if (const auto value = offset_of(text, last.line, last.column);
      value && *value < text.size() && (text[*value] == '{' || text[*value] == '[')) {
    const auto closed = closing(text, *value);
    if (!closed) return false;
    end = *closed;
  } else {
    end = offset_of(text, last_line(map), 1).value_or(text.size());
  }
  end = text.find('\n', end);
  if (end == std::string::npos) text += '\n', end = text.size() - 1;
  text.insert(end + 1, indent + entry + "\n");
  return true;
}

bool replace(std::string& text, const YamlNode& node, const std::string& value) {
  const auto at = offset_of(text, node.line, node.column);
  if (!at || !node.is_plain() || text.compare(*at, node.text.size(), node.text) != 0) return false;
  text.replace(*at, node.text.size(), value);
  return true;
}

bool set(std::string& text, std::string_view name, const Setting& setting) {
  const YamlNode root = parse_yaml(text, name);
  const YamlNode* node = &root;
  std::string_view rest = setting.key;
  while (true) {
    if (node->kind != YamlNode::Kind::map) return false;
    const std::size_t dot = rest.find('.');
    const YamlNode* const next = find_in(*node, rest.substr(0, dot));
    if (!next) {
      std::string entry(rest.substr(0, dot)), ends;
      while (rest.find('.') != std::string_view::npos) {
        rest.remove_prefix(rest.find('.') + 1);
        entry += ": {" + std::string(rest.substr(0, rest.find('.')));
        ends += '}';
      }
      return add_to(text, *node, entry + ": " + setting.value + ends);
    }
    if (dot == std::string_view::npos) return replace(text, *next, setting.value);
    node = next;
    rest.remove_prefix(dot + 1);
  }
}

void flatten(const YamlNode& node, const std::string& key,
             std::map<std::string, std::string>& values) {
  if (node.kind == YamlNode::Kind::map) {
    for (std::size_t i = 0; i + 1 < node.items.size(); i += 2)
      flatten(node.items[i + 1], (key.empty() ? "" : key + ".") + node.items[i].text, values);
  } else {
    values[key] = flow_text(node);
  }
}

std::map<std::string, std::string> values_of(std::string_view text, std::string_view name) {
  std::map<std::string, std::string> values;
  flatten(parse_yaml(text, name), "", values);
  return values;
}

}  // namespace

std::string edit_yaml(std::string_view text, std::string_view name,
                      std::span<const Setting> settings) {
  std::string edited(text);
  std::map<std::string, std::string> wanted = values_of(text, name);
  std::string lines;
  for (const Setting& setting : settings) {
    wanted[setting.key] = setting.value;
    lines += (lines.empty() ? "" : ", ") + setting.key + ": " + setting.value;
  }
  const bool done = std::ranges::all_of(
      settings, [&](const Setting& setting) { return set(edited, name, setting); });
  bool same = false;
  try {
    same = done && values_of(edited, name) == wanted;
  } catch (const InputError&) {  // the edited text is no YAML
  }
  if (!same)
    throw InputError(std::string(name),
                     "its form cannot be kept: write these values by hand: " + lines);
  return edited;
}

}  // namespace microswarm
