// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "microswarm/actuation/coils/mpem.hpp"
#include "microswarm/actuation/coils/si.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

using Kind = YamlNode::Kind;

constexpr std::size_t max_order = 20;
constexpr std::size_t max_coils_of_file = 1000;

/// Reader of one calibration; `label` names a part of it in error messages: "Src_1 of Coil_0".
class Reader {
 public:
  explicit Reader(std::string_view name) : name_(name) {}

  MpemSystem read(const YamlNode& root) const {
    if (root.kind != Kind::map) fail(root, "must be a mapping with the key 'Coil_List'");
    MpemSystem system;
    const std::string label = "the calibration";
    if (const YamlNode* name = find(root, "System_Name")) system.name = word(*name, "System_Name");
    const std::vector<std::string> coils = list(need(root, "Coil_List", label), "Coil_List");
    for (const std::string& coil : coils) {
      std::vector<Multipole> sources =
          read_coil(need(root, coil, "the calibration, where Coil_List names it"), coil);
      if (coil == "Offset")
        system.offset = std::move(sources);
      else
        system.coils.push_back({coil, std::move(sources)});
    }
    if (system.coils.empty()) fail(root, "no coils in Coil_List");
    read_workspace(root, system);
    return system;
  }

 private:
  [[noreturn]] void fail(const YamlNode& node, const std::string& what) const {
    throw InputError(std::string(name_), std::max(node.line, 1), std::max(node.column, 1), what);
  }

  static const YamlNode* find(const YamlNode& map, std::string_view key) {
    for (std::size_t i = 0; i < map.items.size(); i += 2)
      if (map.items[i].text == key) return &map.items[i + 1];
    return nullptr;
  }

  const YamlNode& need(const YamlNode& map, std::string_view key, const std::string& label) const {
    if (map.kind != Kind::map) fail(map, label + " must be a mapping of keys");
    if (const YamlNode* found = find(map, key)) return *found;
    std::vector<std::string_view> keys;
    for (std::size_t i = 0; i < map.items.size(); i += 2)
      if (map.items[i].text.size() == key.size()) keys.push_back(map.items[i].text);
    std::string why = fmt::format("missing key {} in {}", quote(key), label);
    const std::string_view near = nearest_word(key, keys);
    if (!near.empty() && find(map, key) == nullptr && near.find(' ') != near.npos)
      why += fmt::format(" ({} is there)", quote(near));
    fail(map, why);
  }

  std::string word(const YamlNode& node, const std::string& label) const {
    if (node.kind != Kind::scalar || node.text.empty()) fail(node, label + " must be a word");
    return node.text;
  }

  std::vector<std::string> list(const YamlNode& node, const std::string& label) const {
    if (node.kind != Kind::list || node.items.empty() || node.items.size() > max_coils_of_file)
      fail(node, fmt::format("{} must be a list of 1..{} names", label, max_coils_of_file));
    std::vector<std::string> names;
    std::set<std::string> seen;
    for (const YamlNode& item : node.items) {
      names.push_back(word(item, "a name in " + label));
      if (!seen.insert(names.back()).second)
        fail(item, fmt::format("{} stands twice in {}", quote(names.back()), label));
    }
    return names;
  }

  double number(const YamlNode& node, const std::string& label) const {
    const std::optional<double> value =
        node.is_plain() ? parse_number(node.text) : std::optional<double>();
    if (!value) fail(node, label + " must hold numbers");
    return *value;
  }

  /// A list of numbers; empty for a null node.
  std::vector<double> numbers(const YamlNode& node, const std::string& label) const {
    std::vector<double> values;
    if (node.kind == Kind::null) return values;
    if (node.kind != Kind::list) fail(node, label + " must be a list of numbers");
    for (const YamlNode& item : node.items) values.push_back(number(item, label));
    return values;
  }

  Eigen::Vector3d vector(const YamlNode& node, const std::string& label) const {
    const std::vector<double> v = numbers(node, label);
    if (v.size() != 3) fail(node, fmt::format("{} has {} numbers, must have 3", label, v.size()));
    return {v[0], v[1], v[2]};
  }

  std::vector<Multipole> read_coil(const YamlNode& coil, const std::string& name) const {
    std::vector<Multipole> sources;
    for (const std::string& source :
         list(need(coil, "Source_List", name), "Source_List of " + name)) {
      const YamlNode& node = need(coil, source, name + ", where Source_List names it");
      sources.push_back(read_source(node, source + " of " + name));
    }
    return sources;
  }

  Multipole read_source(const YamlNode& node, const std::string& label) const {
    Multipole source;
    source.position = vector(need(node, "Source_Position", label), "Source_Position in " + label);
    const YamlNode& direction = need(node, "Source_Direction", label);
    source.direction = vector(direction, "Source_Direction in " + label);
    const double length = source.direction.norm();
    if (!(length > 1e-150 && length < 1e150))
      fail(direction, "Source_Direction in " + label + " has no direction");
    source.direction /= length;
    source.A = coefficients(node, "A_Coeff", label);
    source.B = coefficients(node, "B_Coeff", label);
    if (source.A.empty() && source.B.empty())
      fail(node, "missing coefficients in " + label + ": A_Coeff and B_Coeff are both empty");
    return source;
  }

  std::vector<double> coefficients(const YamlNode& source, const char* key,
                                   const std::string& label) const {
    const YamlNode& node = need(source, key, label);
    std::vector<double> values = numbers(node, key + (" in " + label));
    if (values.size() > max_order)
      fail(node, fmt::format("{} in {} has {} numbers, at most {}", key, label, values.size(),
                             max_order));
    return values;
  }

  void read_workspace(const YamlNode& root, MpemSystem& system) const {
    system.lo.setConstant(-std::numeric_limits<double>::infinity());
    system.hi = -system.lo;
    const YamlNode* node = find(root, "Workspace_Dimensions");
    if (!node || node->kind == Kind::null) return;
    if (node->kind != Kind::list || node->items.size() != 3)
      fail(*node, "Workspace_Dimensions must be three pairs [least, most]");
    for (int axis = 0; axis < 3; ++axis) {
      const YamlNode& range = node->items[static_cast<std::size_t>(axis)];
      const std::vector<double> ends = numbers(range, "Workspace_Dimensions");
      if (ends.size() != 2 || !(ends[0] < ends[1]))
        fail(range, "Workspace_Dimensions must be three pairs [least, most]");
      system.lo[axis] = um_per_m * ends[0];
      system.hi[axis] = um_per_m * ends[1];
    }
  }

  std::string_view name_;
};

}  // namespace

MpemSystem parse_mpem(std::string_view text, std::string_view name) {
  return Reader(name).read(parse_yaml(text, name));
}

MpemSystem read_mpem(const std::filesystem::path& path) {
  return parse_mpem(read_file(path, max_yaml_bytes), path.string());
}

}  // namespace microswarm::actuation
