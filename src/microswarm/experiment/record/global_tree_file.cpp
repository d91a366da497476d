// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/global_tree_file.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/io/hdf5_image.hpp"

namespace microswarm::experiment {
namespace {

constexpr std::string_view tree_format_name = "microswarm global-input tree";
constexpr std::int64_t tree_format_version = 1;

std::string hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

/// Name such as "/nodes/robot1_x_um".
std::string column(std::size_t k) {
  return fmt::format("/nodes/robot{}_{}_um", k / 2 + 1, k % 2 == 0 ? 'x' : 'y');
}

void write_root(io::Hdf5Writer& out, const planning::GlobalTree& tree,
                const formats::LoadedMap& map) {
  out.attribute("/", "format", tree_format_name);
  out.attribute("/", "format_version", tree_format_version);
  out.attribute("/", "version", version);
  out.attribute("/", "map_hash", hex(map.input_hash));
  out.attribute("/", "robots", static_cast<std::int64_t>(tree.robots));
  out.attribute("/", "directions", static_cast<std::int64_t>(tree.moves.size()));
  out.attribute("/", "robostep_um", tree.robostep);
  out.attribute("/", "separation_um", tree.separation);
  out.attribute("/", "contact", enum_name(tree.contact));
  out.attribute("/", "origin_x_um", tree.origin.x);
  out.attribute("/", "origin_y_um", tree.origin.y);
}

/// Every `stride`-th entry of `positions`, from entry k on.
std::vector<float> every(const std::vector<float>& positions, std::size_t stride, std::size_t k) {
  std::vector<float> some;
  some.reserve(positions.size() / stride);
  for (std::size_t i = k; i < positions.size(); i += stride) some.push_back(positions[i]);
  return some;
}

void write_indices(io::Hdf5Writer& out, const std::string& path, const auto& indices,
                   std::string_view doc) {
  out.dataset(path, std::vector<std::int64_t>(indices.begin(), indices.end()));
  out.attribute(path, "description", doc);
}

class Reader {
 public:
  Reader(const std::filesystem::path& file, const formats::LoadedMap& map)
      : in_(io::read_hdf5(read_file(file), file.string())), map_(map) {}

  planning::GlobalTree run() {
    check_origin();
    read_root();
    read_nodes();
    replay();
    return std::move(tree_);
  }

 private:
  void check_origin() const {
    if (in_->text_attribute("/", "format") != tree_format_name)
      in_->fail("holds no tree of global inputs");
    const std::int64_t written = in_->integer_attribute("/", "format_version");
    if (written != tree_format_version)
      in_->fail(fmt::format("has tree format {}, this program reads format {}", written,
                            tree_format_version));
    const std::string hash = in_->text_attribute("/", "map_hash");
    if (hash != hex(map_.input_hash))
      in_->fail(fmt::format("was grown on another map: its hash is {}, this map's is {}", hash,
                            hex(map_.input_hash)));
  }

  std::int64_t whole(const char* name, std::int64_t least, std::int64_t most) const {
    const std::int64_t value = in_->integer_attribute("/", name);
    if (value < least || value > most)
      in_->fail(fmt::format("attribute {} is {}, allowed {}..{}", name, value, least, most));
    return value;
  }
  double length(const char* name, double least) const {
    const double value = in_->number_attribute("/", name);
    if (!(value >= least && value <= 1e6))
      in_->fail(fmt::format("attribute {} is {}, allowed {}..1e6", name, value, least));
    return value;
  }

  void read_root() {
    tree_.robots = static_cast<std::size_t>(whole("robots", 1, planning::max_global_robots));
    tree_.robostep = length("robostep_um", 1e-3);
    tree_.separation = length("separation_um", 0);
    const auto directions = static_cast<int>(whole("directions", 3, 256));
    tree_.moves = planning::input_moves(directions, tree_.robostep);
    const std::string contact = in_->text_attribute("/", "contact");
    const auto rule = enum_value<ContactRule>(contact);
    if (!rule) in_->fail("attribute contact is the unknown word '" + contact + "'");
    tree_.contact = *rule;
    tree_.origin = map_.map->bounds().centre();
  }

  void read_nodes() {
    const std::vector<std::int64_t> parents = in_->integers("/nodes/parent");
    const std::vector<std::int64_t> inputs = in_->integers("/nodes/input");
    const std::size_t count = parents.size();
    if (count == 0) in_->fail("has no nodes");
    if (inputs.size() != count) in_->fail("/nodes/input is not as long as /nodes/parent");
    tree_.reserve(count);
    tree_.configurations.resize(2 * tree_.robots * count);
    for (std::size_t k = 0; k < 2 * tree_.robots; ++k) {
      const std::vector<double> positions = in_->numbers(column(k));
      if (positions.size() != count) in_->fail(column(k) + " is not as long as /nodes/parent");
      for (std::size_t node = 0; node < count; ++node)
        tree_.configurations[2 * tree_.robots * node + k] = static_cast<float>(positions[node]);
    }
    for (std::size_t node = 0; node < count; ++node) {
      const auto before = static_cast<std::int64_t>(node == 0 ? 1 : node);
      if (parents[node] < 0 || parents[node] >= before)
        in_->fail(fmt::format("node {} has the parent {}", node, parents[node]));
      if (inputs[node] < 0 || inputs[node] >= std::ssize(tree_.moves))
        in_->fail(fmt::format("node {} has the input {}", node, inputs[node]));
      tree_.parents.push_back(static_cast<std::uint32_t>(parents[node]));
      tree_.inputs.push_back(static_cast<std::uint8_t>(inputs[node]));
    }
  }

  void replay() const {
    const RobotStepper stepper = planning::input_stepper(*map_.map, tree_.robostep);
    for (std::size_t i = 0; i < tree_.robots; ++i)
      if (!map_.map->is_free(tree_.position(0, i), 0))
        in_->fail(fmt::format("robot {} of the first node is in a wall", i + 1));
    for (std::uint32_t node = 1; node < tree_.size(); ++node) {
      const std::span<const float> from = tree_.configuration(tree_.parents[node]);
      const std::span<const float> to = tree_.configuration(node);
      const PointF move = tree_.moves[tree_.inputs[node]];
      for (std::size_t i = 0; i < to.size(); i += 2) {
        const PointF p = stepper.moved({from[i], from[i + 1]}, move, tree_.contact);
        if (p.x == to[i] && p.y == to[i + 1]) continue;
        in_->fail(
            fmt::format("node {} is not where its input leads: the file is damaged or was "
                        "grown by version {}, which moves robots otherwise",
                        node, in_->text_attribute("/", "version")));
      }
    }
  }

  std::unique_ptr<const io::Hdf5Reader> in_;
  const formats::LoadedMap& map_;
  planning::GlobalTree tree_;
};

}  // namespace

void write_global_tree(const planning::GlobalTree& tree, const formats::LoadedMap& map,
                       const std::filesystem::path& file) {
  const auto made = io::write_hdf5();
  io::Hdf5Writer& out = *made;
  write_root(out, tree, map);
  for (std::size_t k = 0; k < 2 * tree.robots; ++k) {
    out.dataset(column(k), every(tree.configurations, 2 * tree.robots, k));
    out.attribute(column(k), "unit", "µm");
  }
  write_indices(out, "/nodes/parent", tree.parents, "Node before, counted from 0.");
  write_indices(out, "/nodes/input", tree.inputs,
                "Index of the input that leads there from the node before, counted from 0.");
  std::vector<double> x, y;
  for (const PointF move : tree.moves)
    x.push_back(static_cast<double>(move.x)), y.push_back(static_cast<double>(move.y));
  out.dataset("/inputs/x_um", x);
  out.dataset("/inputs/y_um", y);
  write_file_atomically(file, out.finish());
}

planning::GlobalTree read_global_tree(const std::filesystem::path& file,
                                      const formats::LoadedMap& map) {
  return Reader(file, map).run();
}

}  // namespace microswarm::experiment
