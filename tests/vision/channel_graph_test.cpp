// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/channel_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/vessels/outline.hpp"
#include "microswarm/vision/vessels/thinning.hpp"
#include "tests/cases.hpp"

namespace microswarm::vision {
namespace {

/// Map that is free where `is_free` says so of the middles of cells of 1 µm.
Map drawn_map(int width, int height, const std::function<bool(Vec2)>& is_free) {
  formats::Mask mask(width, height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      mask.at(column, row) = is_free({column + 0.5, height - row - 0.5});
  return Map({{0, 0}, {1.0 * width, 1.0 * height}}, walls_around(mask, 1, 1));
}

double off_line(Vec2 p, Vec2 a, Vec2 b) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return distance(p, a + t * (b - a));
}

TEST(ChannelGraph, AStraightChannelIsOneBranchOfItsWidth) {
  for (const Vec2 to : {Vec2{260, 200}, Vec2{340, 290}, Vec2{200, 340}, Vec2{330, 215}}) {
    const Vec2 from{60, 200};
    const Map map = drawn_map(400, 400, [&](Vec2 p) { return off_line(p, from, to) < 12; });
    const ChannelGraph graph = channel_graph(map, 1);
    ASSERT_EQ(graph.branches.size(), 1U) << to.x;
    EXPECT_EQ(graph.nodes.size(), 2U);
    const ChannelBranch& branch = graph.branches[0];
    EXPECT_EQ(branch.type, BranchType::end_end);
    EXPECT_NEAR(branch.mean_width, 24, 1);
    EXPECT_NEAR(branch.length, distance(from, to), 0.03 * distance(from, to) + 4);
  }
}

TEST(ChannelGraph, CornersOfAChannelAreNoBranches) {
  const Map map({{0, 0}, {400, 100}},
                {Polygon{.outer = {{0, 0}, {400, 0}, {400, 30}, {0, 30}}},
                 Polygon{.outer = {{0, 70}, {400, 70}, {400, 100}, {0, 100}}}});
  const ChannelGraph graph = channel_graph(map, 1);
  ASSERT_EQ(graph.branches.size(), 1U);
  EXPECT_NEAR(graph.branches[0].mean_width, 40, 0.1);
  EXPECT_NEAR(graph.branches[0].length, 360, 4);
}

TEST(ChannelGraph, AForkHasThreeBranchesThatMeet) {
  const Vec2 middle{200, 200};
  const Vec2 ends[] = {{30, 190}, {360, 330}, {350, 60}};
  const double widths[] = {30, 20, 12};
  const Map map = drawn_map(400, 400, [&](Vec2 p) {
    for (int i = 0; i < 3; ++i)
      if (off_line(p, middle, ends[i]) < widths[i] / 2) return true;
    return false;
  });
  const ChannelGraph graph = channel_graph(map, 1);
  ASSERT_EQ(graph.branches.size(), 3U);
  ASSERT_EQ(graph.nodes.size(), 4U);
  std::vector<double> found;
  for (const ChannelBranch& branch : graph.branches) {
    EXPECT_EQ(branch.type, BranchType::junction_end);
    const ChannelNode& junction =
        graph.nodes[graph.nodes[branch.a].degree == 3 ? branch.a : branch.b];
    EXPECT_EQ(junction.degree, 3);
    EXPECT_LT(distance(junction.position, middle), 12);
    found.push_back(branch.mean_width);
  }
  std::sort(found.begin(), found.end());
  EXPECT_NEAR(found[0], 12, 0.7);
  EXPECT_NEAR(found[1], 20, 0.7);
  EXPECT_NEAR(found[2], 30, 0.7);
}

TEST(ChannelGraph, ARingIsALoop) {
  const Map map = drawn_map(300, 300, [](Vec2 p) {
    return std::abs(distance(p, Vec2{150, 150}) - 100) < 8;
  });
  const ChannelGraph graph = channel_graph(map, 1);
  ASSERT_EQ(graph.branches.size(), 1U);
  EXPECT_EQ(graph.branches[0].type, BranchType::loop);
  EXPECT_EQ(graph.branches[0].a, graph.branches[0].b);
  EXPECT_NEAR(graph.branches[0].length, 200 * std::numbers::pi, 0.02 * 200 * std::numbers::pi);
  EXPECT_NEAR(graph.branches[0].mean_width, 16, 0.6);
}

TEST(ChannelGraph, ANeckIsTheNarrowestPlaceAndPartsAreNetworks) {
  const Map map = drawn_map(400, 200, [](Vec2 p) {
    const double half = std::abs(p.x - 140) < 6 ? 5 : 10;
    return (std::abs(p.y - 60) < half && p.x > 20 && p.x < 380) ||
           (std::abs(p.y - 150) < 7 && p.x > 50 && p.x < 350);
  });
  const ChannelGraph graph = channel_graph(map, 1);
  ASSERT_EQ(graph.branches.size(), 2U);
  EXPECT_NE(graph.branches[0].network, graph.branches[1].network);
  const auto& neck = graph.branches[graph.branches[0].line[0].y < 100 ? 0 : 1];
  EXPECT_NEAR(neck.min_width, 10, 1);
  EXPECT_NEAR(neck.narrowest.x, 140, 8);
  EXPECT_NEAR(neck.max_width, 20, 1);
}

TEST(ChannelGraph, TablesHaveALineForEach) {
  const Map map({{0, 0}, {400, 100}}, {Polygon{.outer = {{0, 0}, {400, 0}, {400, 30}, {0, 30}}}});
  const ChannelGraph graph = channel_graph(map, 2);
  const auto lines = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines(branch_table(graph)), 1 + static_cast<int>(graph.branches.size()));
  EXPECT_EQ(lines(node_table(graph)), 1 + static_cast<int>(graph.nodes.size()));
  EXPECT_NE(branch_table(graph).find("1,1,end-end,1,2,"), std::string::npos) << branch_table(graph);
}

// Each end of a branch is counted at its node, whatever the map.
TEST(ChannelGraph, DegreesAreEndsOfBranches) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed, Purpose::test);
    std::vector<Disc> discs;
    for (int i = 0; i < 30; ++i)
      discs.push_back({{rng.uniform(0, 300), rng.uniform(0, 300)}, rng.uniform(10, 40)});
    const ChannelGraph graph = channel_graph(Map({{0, 0}, {300, 300}}, {}, discs), 1.5);
    std::vector<int> degree(graph.nodes.size(), 0);
    for (const ChannelBranch& branch : graph.branches) {
      ++degree[branch.a], ++degree[branch.b];
      EXPECT_LE(branch.min_width, branch.mean_width + 1e-9);
      EXPECT_LE(branch.mean_width, branch.max_width + 1e-9);
      EXPECT_GE(branch.length,
                0.95 * distance(graph.nodes[branch.a].position, graph.nodes[branch.b].position));
    }
    for (std::size_t n = 0; n < degree.size(); ++n) EXPECT_EQ(degree[n], graph.nodes[n].degree);
  }
}

int count(const cv::Mat& set, int connectivity) {
  cv::Mat labels;
  return cv::connectedComponents(set, labels, connectivity, CV_32S);
}

TEST(Thinning, KeepsPiecesAndHolesAndLeavesNothingToRemove) {
  for (int seed = 0; seed < test::cases(200); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed), Purpose::test);
    formats::Mask mask(30, 24);
    const double share = rng.uniform(0.3, 0.9);
    for (std::uint8_t& c : mask.cells) c = rng.uniform() < share;
    const auto holes = [](const formats::Mask& m) {
      cv::Mat wide;
      cv::copyMakeBorder(to_mat(m), wide, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
      return count(~wide, 4);
    };
    formats::Mask thinned = mask;
    thin(thinned);
    EXPECT_EQ(count(to_mat(thinned), 8), count(to_mat(mask), 8)) << seed;
    EXPECT_EQ(holes(thinned), holes(mask)) << seed;
    for (std::size_t i = 0; i < mask.cells.size(); ++i) EXPECT_LE(thinned.cells[i], mask.cells[i]);
    formats::Mask again = thinned;
    thin(again);
    EXPECT_EQ(again, thinned) << seed;
  }
}

}  // namespace
}  // namespace microswarm::vision
