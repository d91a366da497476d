// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/global_tree_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/planning/global_input/global_rrt.hpp"

namespace microswarm::experiment {
namespace {

formats::LoadedMap room(double wall_x) {
  formats::RectanglesMap spec;
  spec.lo = Vec2{50, 50};
  spec.hi = Vec2{350, 350};
  spec.rectangles = {{wall_x, 150, 100, 25}, {150, 150, 25, 100}};
  return formats::load_map(spec);
}

planning::GlobalTree grown(const formats::LoadedMap& map, const planning::GlobalRrtParams& params) {
  Rng rng(1, Purpose::planner);
  const std::vector<Vec2> starts{{60, 300}, {60, 250}, {60, 200}};
  return planning::global_rrt(*map.map, starts, {}, params, rng).tree;
}

class GlobalTreeFile : public testing::Test {
 protected:
  GlobalTreeFile()
      : file(std::filesystem::path(testing::TempDir()) /
             ("microswarm_tree_" + std::to_string(::getpid()) + ".h5")) {}
  ~GlobalTreeFile() override { std::filesystem::remove(file); }

  /// What reading it says is wrong, without the file's name.
  std::string fault(const formats::LoadedMap& map) const {
    try {
      read_global_tree(file, map);
      return "";
    } catch (const InputError& e) {
      const std::string what = e.what();
      EXPECT_TRUE(what.starts_with(file.string() + ": ")) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos);
      return what.substr(file.string().size() + 2);
    }
  }

  std::filesystem::path file;
};

TEST_F(GlobalTreeFile, ComesBackToTheBits) {
  const formats::LoadedMap map = room(175);
  for (const planning::GlobalRrtParams& params :
       {planning::GlobalRrtParams{.max_nodes = 5000}, planning::GlobalRrtParams{.max_nodes = 1},
        planning::GlobalRrtParams{
            .directions = 4, .contact = ContactRule::stop, .separation = 12, .max_nodes = 700}}) {
    const planning::GlobalTree tree = grown(map, params);
    write_global_tree(tree, map, file);
    const std::string bytes = read_file(file);
    const planning::GlobalTree back = read_global_tree(file, map);
    EXPECT_EQ(back.robots, tree.robots);
    EXPECT_EQ(back.origin, tree.origin);
    EXPECT_EQ(back.robostep, tree.robostep);
    EXPECT_EQ(back.contact, tree.contact);
    EXPECT_EQ(back.separation, tree.separation);
    EXPECT_EQ(back.moves.size(), tree.moves.size());
    EXPECT_EQ(back.configurations, tree.configurations);
    EXPECT_EQ(back.parents, tree.parents);
    EXPECT_EQ(back.inputs, tree.inputs);
    const std::vector<Vec2> goals{{330, 100}, {280, 200}, {100, 250}};
    EXPECT_EQ(planning::ask(back, goals, 20).node, planning::ask(tree, goals, 20).node);
    write_global_tree(back, map, file);
    EXPECT_EQ(read_file(file), bytes);
  }
}

TEST_F(GlobalTreeFile, RefusesWhatDoesNotFit) {
  const formats::LoadedMap map = room(175);
  const planning::GlobalTree tree = grown(map, {.max_nodes = 200});
  const auto saved = [&](const std::function<void(planning::GlobalTree&)>& change) {
    planning::GlobalTree other = tree;
    change(other);
    write_global_tree(other, map, file);
    return fault(map);
  };
  EXPECT_EQ(saved([](planning::GlobalTree&) {}), "");
  EXPECT_TRUE(fault(room(176)).starts_with("was grown on another map: its hash is "));
  EXPECT_TRUE(saved([](planning::GlobalTree& t) {
                t.configurations[100] += 1e-4f;
              }).find("is not where its input leads") != std::string::npos);
  EXPECT_TRUE(saved([](planning::GlobalTree& t) {
                t.contact = ContactRule::reject;
              }).find("is not where its input leads") != std::string::npos);
  EXPECT_EQ(saved([](planning::GlobalTree& t) { t.parents[7] = 7; }), "node 7 has the parent 7");
  EXPECT_EQ(saved([](planning::GlobalTree& t) { t.inputs[5] = 16; }), "node 5 has the input 16");
  EXPECT_EQ(saved([](planning::GlobalTree& t) { t.parents.pop_back(); }),
            "/nodes/input is not as long as /nodes/parent");
  EXPECT_EQ(saved([](planning::GlobalTree& t) { t.robostep = 0; }),
            "attribute robostep_um is 0, allowed 0.001..1e6");
  EXPECT_EQ(saved([](planning::GlobalTree& t) { t.configurations[0] = 1e6f; }),
            "robot 1 of the first node is in a wall");
}

TEST_F(GlobalTreeFile, RefusesWhatIsNoTree) {
  const formats::LoadedMap map = room(175);
  write_global_tree(grown(map, {.max_nodes = 200}), map, file);
  const std::string bytes = read_file(file);
  write_file_atomically(file, "no HDF5");
  EXPECT_EQ(fault(map), "no HDF5 file, or a damaged one");
  write_file_atomically(file, bytes.substr(0, bytes.size() / 2));
  EXPECT_NE(fault(map), "");
  // Whatever is damaged, it ends in one line or in the same tree.
  for (std::size_t at = 0; at < bytes.size(); at += 97) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    write_file_atomically(file, damaged);
    fault(map);
  }
}

}  // namespace
}  // namespace microswarm::experiment
