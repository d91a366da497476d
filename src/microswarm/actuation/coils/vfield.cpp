// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/vfield.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "microswarm/actuation/coils/si.hpp"
#include "microswarm/actuation/coils/text_rows.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr int max_nodes = 1000;  // per direction
constexpr std::int64_t max_values = 4'000'000;
constexpr double min_extent = 1e-9;  // [m]
constexpr double max_field = 1e3;    // [T] per ampere

/// Error message for an invalid range of the grid; empty if it is valid.
std::string complaint(int nodes, double least, double most) {
  if (nodes < 2 || nodes > max_nodes)
    return fmt::format("{} nodes in one direction, allowed 2..{}", nodes, max_nodes);
  if (!(most - least >= min_extent))
    return fmt::format("range {} .. {} m, must ascend", number_text(least), number_text(most));
  return {};
}

/// Error message for an invalid field; empty if it is valid.
std::string complaint(std::span<const double> field) {
  for (const double b : field)
    if (!(std::abs(b) <= max_field))
      return fmt::format("a field of {} T for one ampere, allowed -{}..{}", number_text(b),
                         number_text(max_field), number_text(max_field));
  return {};
}

/// Keys of the YAML format.
struct VfieldYaml {
  std::string name;
  std::array<int, 3> nodes{2, 2, 2};
  std::array<double, 3> least{}, most{};
  std::vector<std::vector<double>> data;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, plain("name", "Name of the coil."));
    visit(self.nodes[0], plain("dim_x", 2, max_nodes, "Nodes in x.").needed());
    visit(self.nodes[1], plain("dim_y", 2, max_nodes, "Nodes in y.").needed());
    visit(self.nodes[2], plain("dim_z", 2, max_nodes, "Nodes in z.").needed());
    visit(self.least[0], plain("min_x", -1e6, 1e6, "Least x in m.").needed());
    visit(self.most[0], plain("max_x", -1e6, 1e6, "Greatest x in m.").needed());
    visit(self.least[1], plain("min_y", -1e6, 1e6, "Least y in m.").needed());
    visit(self.most[1], plain("max_y", -1e6, 1e6, "Greatest y in m.").needed());
    visit(self.least[2], plain("min_z", -1e6, 1e6, "Least z in m.").needed());
    visit(self.most[2], plain("max_z", -1e6, 1e6, "Greatest z in m.").needed());
    visit(self.data, plain("data", "[Bx, By, Bz] in T of each node.").needed());
  }
};

}  // namespace

FieldGrid::FieldGrid(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi, std::array<int, 3> nodes,
                     std::vector<Eigen::Vector3d> values)
    : lo_(lo), hi_(hi), nodes_(nodes), values_(std::move(values)) {
  assert(std::min({nodes[0], nodes[1], nodes[2]}) >= 2);
  assert(values_.size() == static_cast<std::size_t>(nodes[0]) * nodes[1] * nodes[2]);
  for (int axis = 0; axis < 3; ++axis)
    step_[axis] = (hi[axis] - lo[axis]) / (nodes[static_cast<std::size_t>(axis)] - 1);
}

bool FieldGrid::contains(const Eigen::Vector3d& position) const {
  return (position.array() >= lo_.array()).all() && (position.array() <= hi_.array()).all();
}

const Eigen::Vector3d& FieldGrid::node(int i, int j, int k) const {
  const auto row = static_cast<std::size_t>(i) * nodes_[1] + j;
  return values_[row * nodes_[2] + k];
}

FieldGradient FieldGrid::at(const Eigen::Vector3d& position) const {
  assert(contains(position));
  std::array<int, 3> cell{};
  Eigen::Vector3d share;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto d = static_cast<Eigen::Index>(axis);
    const double at = (position[d] - lo_[d]) / step_[d];
    cell[axis] = std::clamp(static_cast<int>(std::floor(at)), 0, nodes_[axis] - 2);
    share[d] = at - cell[axis];
  }
  FieldGradient sum;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d weight, slope;
    for (int d = 0; d < 3; ++d) {
      const bool upper = corner >> d & 1;
      weight[d] = upper ? share[d] : 1 - share[d];
      slope[d] = (upper ? 1 : -1) / step_[d];
    }
    const Eigen::Vector3d& value =
        node(cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1));
    sum.field += weight.prod() * value;
    const Eigen::RowVector3d change(slope[0] * weight[1] * weight[2],
                                    weight[0] * slope[1] * weight[2],
                                    weight[0] * weight[1] * slope[2]);
    sum.gradient += value * change;
  }
  return sum;
}

FieldGrid parse_vfield_text(std::string_view text, std::string_view name) {
  TextRows rows(text, name);
  const auto numbers = [&](std::size_t count, const char* what) {
    return rows.numbers(count, ' ', what);
  };
  const double total = numbers(1, "the number of nodes")[0];
  const std::vector<double> dims = numbers(3, "the nodes in x, y and z");
  std::array<int, 3> nodes{};
  for (std::size_t d = 0; d < 3; ++d) {
    if (!(dims[d] >= 2 && dims[d] <= max_nodes) || dims[d] != std::floor(dims[d]))
      rows.fail(
          fmt::format("{} nodes in one direction, allowed 2..{}", number_text(dims[d]), max_nodes));
    nodes[d] = static_cast<int>(dims[d]);
  }
  const std::int64_t count = std::int64_t{nodes[0]} * nodes[1] * nodes[2];
  if (total != static_cast<double>(count) || count > max_values)
    rows.fail(fmt::format("{} nodes in all, {} × {} × {} are {}, at most {}", number_text(total),
                          nodes[0], nodes[1], nodes[2], count, max_values));
  Eigen::Vector3d lo, hi;
  for (int d = 0; d < 3; ++d) {
    const std::vector<double> range = numbers(2, "the least and the greatest coordinate");
    const std::string wrong = complaint(nodes[static_cast<std::size_t>(d)], range[0], range[1]);
    if (!wrong.empty() || std::abs(range[0]) > 1e6 || std::abs(range[1]) > 1e6)
      rows.fail(wrong.empty() ? "coordinates are m, at most 1e6" : wrong);
    lo[d] = range[0];
    hi[d] = range[1];
  }
  std::vector<Eigen::Vector3d> values;
  for (int i = 0; i < nodes[0]; ++i)
    for (int j = 0; j < nodes[1]; ++j)
      for (int k = 0; k < nodes[2]; ++k) {
        const std::vector<double> row = numbers(6, "a node: x y z Bx By Bz");
        const Eigen::Vector3d share(i / (nodes[0] - 1.0), j / (nodes[1] - 1.0),
                                    k / (nodes[2] - 1.0));
        const Eigen::Vector3d due = lo + share.cwiseProduct(hi - lo);
        const Eigen::Vector3d there(row[0], row[1], row[2]);
        if (!((there - due).array().abs() <= 1e-3 * (hi - lo).array()).all())
          rows.fail(fmt::format("the node at ({}, {}, {}) m is due here: z fastest, x slowest",
                                number_text(due[0]), number_text(due[1]), number_text(due[2])));
        const std::string wrong = complaint(std::span(row).subspan(3));
        if (!wrong.empty()) rows.fail(wrong);
        values.emplace_back(mt_per_t * row[3], mt_per_t * row[4], mt_per_t * row[5]);
      }
  rows.end();
  return {um_per_m * lo, um_per_m * hi, nodes, std::move(values)};
}

FieldGrid parse_vfield_yaml(std::string_view text, std::string_view name) {
  const auto file = read_yaml_text<VfieldYaml>(text, name);
  const auto fail = [&](const std::string& why) -> void {
    throw InputError(std::string(name), why);
  };
  for (std::size_t d = 0; d < 3; ++d)
    if (const std::string wrong = complaint(file.nodes[d], file.least[d], file.most[d]);
        !wrong.empty())
      fail(wrong);
  const std::int64_t count = std::int64_t{file.nodes[0]} * file.nodes[1] * file.nodes[2];
  if (static_cast<std::int64_t>(file.data.size()) != count)
    fail(fmt::format("data has {} nodes, {} × {} × {} are {}", file.data.size(), file.nodes[0],
                     file.nodes[1], file.nodes[2], count));
  std::vector<Eigen::Vector3d> values;
  for (const std::vector<double>& node : file.data) {
    if (node.size() != 3)
      fail(fmt::format("node {} of data has {} numbers, must be [Bx, By, Bz]", values.size() + 1,
                       node.size()));
    if (const std::string wrong = complaint(node); !wrong.empty())
      fail(fmt::format("node {} of data: {}", values.size() + 1, wrong));
    values.emplace_back(mt_per_t * node[0], mt_per_t * node[1], mt_per_t * node[2]);
  }
  const Eigen::Vector3d lo(file.least[0], file.least[1], file.least[2]);
  const Eigen::Vector3d hi(file.most[0], file.most[1], file.most[2]);
  return {um_per_m * lo, um_per_m * hi, file.nodes, std::move(values)};
}

FieldGrid read_vfield(const std::filesystem::path& path) {
  const std::string text = read_file(path, max_yaml_bytes);
  const bool yaml = path.extension() == ".yaml" || path.extension() == ".yml";
  return yaml ? parse_vfield_yaml(text, path.string()) : parse_vfield_text(text, path.string());
}

}  // namespace microswarm::actuation
