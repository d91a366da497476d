// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"

namespace microswarm {
namespace {

struct FileKind {
  std::string_view name;
  std::array<std::string_view, 2> keys;  ///< that only such a file has together
  std::string_view taken_by;             ///< empty: the input for a rig
};

constexpr FileKind kinds[] = {{"scenario", {"map", "navigator"}, "`microswarm run` takes it"},
                              {"scenario", {"map", "swarm"}, "`microswarm run` takes it"},
                              {"scenario", {"map", "robots"}, "`microswarm run` takes it"},
                              {"scenario", {"map", "goal_um"}, "`microswarm run` takes it"},
                              {"sweep", {"scenario", "trials"}, "`microswarm sweep` takes it"},
                              {"sweep", {"scenario", "grid"}, "`microswarm sweep` takes it"},
                              {"queue", {"entries", "entries"}, "`microswarm rig queue` takes it"},
                              {"rig", {"coils", "driver"}, ""},
                              {"rig", {"coils", "camera"}, ""},
                              {"coil system", {"coils", "drives"}, "a rig's key 'coils' names it"},
                              {"ROS map", {"image", "resolution"}, "a map's key 'file' names it"}};

bool has_key(const YamlNode& document, std::string_view key) {
  for (std::size_t i = 0; i + 1 < document.items.size(); i += 2)
    if (document.items[i].text == key) return true;
  return false;
}

}  // namespace

void refuse_other_kind(std::string_view text, std::string_view name, std::string_view expected) {
  YamlNode document;
  try {
    document = parse_yaml(text, name);
  } catch (const InputError&) {
    return;
  }
  if (document.kind != YamlNode::Kind::map) return;
  const auto is_it = [&](const FileKind& kind) {
    return std::ranges::all_of(kind.keys, [&](auto key) { return has_key(document, key); });
  };
  const FileKind* const found = std::ranges::find_if(kinds, is_it);
  if (found == std::end(kinds) || found->name == expected) return;
  const std::string taken_by = found->taken_by.empty() ? "it is given as " + input_name("rig")
                                                       : std::string(found->taken_by);
  throw InputError(std::string(name),
                   fmt::format("this is a {}, not a {}: {}", found->name, expected, taken_by));
}

}  // namespace microswarm
