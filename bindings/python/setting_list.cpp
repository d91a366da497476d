// SPDX-License-Identifier: Apache-2.0
#include "setting_list.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm::python {
namespace {

constexpr std::string_view type_word = ".type";

/// Keys of a map, nested ones in brackets; empty for another value.
std::string keys_in(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::map) return {};
  std::string keys = "{";
  for (std::size_t i = 0; i + 1 < node.items.size(); i += 2) {
    keys += node.items[i].text + keys_in(node.items[i + 1]) + ",";
    if (node.items[i].text == "type") keys += node.items[i + 1].text + ",";
  }
  return keys + "}";
}

std::string keys_in_value(const Setting& setting) {
  try {
    return keys_in(parse_yaml(setting.value, setting.key));
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

std::vector<Setting> with_setting(const std::vector<Setting>& settings, const Setting& added,
                                  const std::function<bool(const std::vector<Setting>&)>& is_same) {
  const std::string_view key = added.key;
  std::vector<Setting> list = settings;
  if (key.ends_with(type_word)) {
    const std::string_view variant = key.substr(0, key.size() - type_word.size());
    const auto is_part = [&](const Setting& s) { return is_in_key(s.key, variant); };
    // The same alternative as before: settings within it are kept.
    std::erase_if(list, [&](const Setting& s) { return s.key == key; });
    list.insert(std::ranges::find_if(list, is_part), added);
    if (is_same(list)) return list;
    if (is_same(settings)) return settings;
    // Another alternative, with its defaults.
    list = settings;
    std::erase_if(list, is_part);
  } else if (const std::string keys = keys_in_value(added); keys.empty()) {
    std::erase_if(list, [&](const Setting& s) { return is_in_key(s.key, key); });
  } else {  // keys that the map does not name are kept
    std::erase_if(list, [&](const Setting& s) { return s.key == key && keys_in_value(s) == keys; });
  }
  const bool is_plain = list.size() == settings.size();
  list.push_back(added);
  if (is_plain || is_same(list)) return list;
  list = settings;
  list.push_back(added);
  return list;
}

}  // namespace microswarm::python
