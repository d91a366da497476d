// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/channel_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/images/rasterise.hpp"
#include "microswarm/vision/vessels/thinning.hpp"

namespace microswarm::vision {
namespace {

using formats::Mask;

constexpr double cells_by_default = 1e6;
constexpr double corner_radii = 1.5;  // how far from its junction a branch must reach
constexpr int max_prunings = 20;
constexpr int line_smoothing = 3;  // cells on either side, of the line whose length is measured
constexpr int off_middle = 3;  // quarters of a cell by which the middle is searched on either side

struct SkeletonCell {
  int column = 0, row = 0;
};

/// A skeleton of cells, traced into nodes and lines.
struct Trace {
  std::vector<std::vector<SkeletonCell>> nodes;  ///< the cells of each
  struct Line {
    int a, b;
    std::vector<SkeletonCell> cells;  ///< between the nodes
  };
  std::vector<Line> lines;
};

class SkeletonTracer {
 public:
  explicit SkeletonTracer(const Mask& skeleton)
      : skeleton_(skeleton), node_(skeleton.cells.size(), -1), seen_(skeleton.cells.size(), 0) {}

  Trace run() {
    each_cell([&](SkeletonCell c) {
      if (node(c) < 0 && count(c) != 2) grow_node(c);
    });
    for (int n = 0; n < static_cast<int>(trace_.nodes.size()); ++n)
      for (const SkeletonCell c : std::vector(trace_.nodes[n]))
        each_neighbour(c, [&](SkeletonCell next) {
          if (node(next) != n) follow(n, c, next);
        });
    each_cell([&](SkeletonCell c) {  // closed lines without a node
      if (node(c) >= 0 || seen(c)) return;
      const int n = static_cast<int>(trace_.nodes.size());
      trace_.nodes.push_back({c});
      node(c) = n;
      bool gone = false;
      each_neighbour(c, [&](SkeletonCell next) {
        if (!std::exchange(gone, true)) follow(n, c, next);
      });
    });
    return std::move(trace_);
  }

 private:
  template <class Visit>
  void each_cell(Visit&& visit) {
    for (int row = 0; row < skeleton_.height; ++row)
      for (int column = 0; column < skeleton_.width; ++column)
        if (skeleton_.at(column, row)) visit(SkeletonCell{column, row});
  }
  template <class Visit>
  void each_neighbour(SkeletonCell c, Visit&& visit) {
    const unsigned set = set_neighbours(skeleton_, c.column, c.row);
    for (int k = 0; k < 8; ++k)
      if (set >> static_cast<unsigned>(k) & 1U)
        visit(SkeletonCell{c.column + neighbour_columns[k], c.row + neighbour_rows[k]});
  }
  int count(SkeletonCell c) const {
    return std::popcount(set_neighbours(skeleton_, c.column, c.row));
  }
  int& node(SkeletonCell c) { return node_[skeleton_.index(c.column, c.row)]; }
  char& seen(SkeletonCell c) { return seen_[skeleton_.index(c.column, c.row)]; }

  /// An end or single cell, or all crossing cells that touch.
  void grow_node(SkeletonCell first) {
    const int n = static_cast<int>(trace_.nodes.size());
    const bool crossing = count(first) > 2;
    std::vector<SkeletonCell> cells{first};
    node(first) = n;
    for (std::size_t i = 0; crossing && i < cells.size(); ++i)
      each_neighbour(SkeletonCell(cells[i]), [&](SkeletonCell next) {
        if (node(next) >= 0 || count(next) <= 2) return;
        node(next) = n;
        cells.push_back(next);
      });
    trace_.nodes.push_back(std::move(cells));
  }

  /// The line that leaves node `a` by `cell`, unless it was followed from its other end.
  void follow(int a, SkeletonCell before, SkeletonCell cell) {
    std::vector<SkeletonCell> cells;
    SkeletonCell last = before;
    while (node(cell) < 0) {
      if (seen(cell)) return;
      cells.push_back(cell);
      seen(cell) = 1;
      SkeletonCell next = last;
      each_neighbour(cell, [&](SkeletonCell c) {
        if (c.column == last.column && c.row == last.row) return;
        const bool known = next.column != last.column || next.row != last.row;
        // A node is preferred; of the cells of the node it came from, none.
        if (!known || (node(c) >= 0 && node(c) != a)) next = c;
      });
      if (next.column == last.column && next.row == last.row) return;
      last = cell;
      cell = next;
    }
    const int b = node(cell);
    if (cells.empty() && b < a) return;  // neighbours: followed once
    trace_.lines.push_back({a, b, std::move(cells)});
  }

  const Mask& skeleton_;
  std::vector<int> node_;
  std::vector<char> seen_;
  Trace trace_;
};

/// Places of cells in the map.
class Places {
 public:
  Places(const Map& map, const Mask& mask, double cell) : map_(map), mask_(mask), cell_(cell) {}

  Vec2 centre(SkeletonCell c) const {
    return formats::cell_centre(mask_, c.column, c.row, cell_, map_.bounds().lo);
  }
  Vec2 centre(const std::vector<SkeletonCell>& cells) const {
    Vec2 sum;
    for (const SkeletonCell c : cells) sum += centre(c);
    return sum / static_cast<double>(cells.size());
  }
  double clearance(Vec2 p) const { return map_.clearance(p); }
  /// The greatest clearance across the line near a point of it, since the middle of a channel is
  /// between the middles of cells.
  double across(Vec2 p, Vec2 direction) const {
    const double length = norm(direction);
    double best = clearance(p);
    if (length == 0) return best;
    const Vec2 step = 0.25 * cell_ / length * Vec2{-direction.y, direction.x};
    for (int i = 1; i <= off_middle; ++i)
      best = std::max({best, clearance(p + i * step), clearance(p - i * step)});
    return best;
  }

 private:
  const Map& map_;
  const Mask& mask_;
  double cell_;
};

std::vector<int> degrees(const Trace& trace) {
  std::vector<int> degree(trace.nodes.size(), 0);
  for (const Trace::Line& line : trace.lines) ++degree[line.a], ++degree[line.b];
  return degree;
}

/// Unsets the branches that end near their junction; whether there were any.
bool prune(Mask& skeleton, const Trace& trace, const Places& places) {
  const std::vector<int> degree = degrees(trace);
  bool pruned = false;
  for (const Trace::Line& line : trace.lines) {
    if (line.a == line.b || (degree[line.a] == 1) == (degree[line.b] == 1)) continue;
    const int end = degree[line.a] == 1 ? line.a : line.b;
    const Vec2 junction = places.centre(trace.nodes[line.a + line.b - end]);
    const double reach = distance(junction, places.centre(trace.nodes[end]));
    if (reach > corner_radii * places.clearance(junction)) continue;
    for (const SkeletonCell c : line.cells) skeleton.at(c.column, c.row) = 0;
    for (const SkeletonCell c : trace.nodes[end]) skeleton.at(c.column, c.row) = 0;
    pruned = true;
  }
  return pruned;
}

std::vector<Vec2> smoothed_line(const std::vector<Vec2>& line) {
  std::vector<Vec2> result(line);
  const int last = static_cast<int>(line.size()) - 1;
  for (int i = 1; i < last; ++i) {
    const int reach = std::min({line_smoothing, i, last - i});
    Vec2 sum;
    for (int k = -reach; k <= reach; ++k) sum += line[i + k];
    result[i] = sum / (2 * reach + 1);
  }
  return result;
}

double polyline_length(const std::vector<Vec2>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += distance(line[i - 1], line[i]);
  return sum;
}

/// Widths along the line, beyond the discs of its ends if it leaves them.
void measure_widths(ChannelBranch& branch, const ChannelNode& a, const ChannelNode& b,
                    const Places& places) {
  const std::vector<Vec2>& line = branch.line;
  const auto is_between = [&](Vec2 p) {
    return distance(p, a.position) > 0.5 * a.width && distance(p, b.position) > 0.5 * b.width;
  };
  const bool leaves = std::any_of(line.begin(), line.end(), is_between);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (leaves && !is_between(line[i])) continue;
    const Vec2 direction = line[std::min(i + 2, line.size() - 1)] - line[i < 2 ? 0 : i - 2];
    const double width = 2 * places.across(line[i], direction);
    if (count == 0 || width < branch.min_width) {
      branch.min_width = width;
      branch.narrowest = line[i];
    }
    branch.max_width = std::max(branch.max_width, width);
    sum += width;
    ++count;
  }
  branch.mean_width = sum / count;
}

/// Numbers the connected parts, in the order of their first nodes.
void number_networks(ChannelGraph& graph) {
  std::vector<int> root(graph.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int n) {
    while (root[n] != n) n = root[n] = root[root[n]];
    return n;
  };
  for (const ChannelBranch& branch : graph.branches) {
    const int a = find(branch.a);
    const int b = find(branch.b);
    root[std::max(a, b)] = std::min(a, b);
  }
  int networks = 0;
  for (int n = 0; n < static_cast<int>(root.size()); ++n)
    graph.nodes[n].network = find(n) == n ? ++networks : graph.nodes[find(n)].network;
  for (ChannelBranch& branch : graph.branches) branch.network = graph.nodes[branch.a].network;
}

ChannelGraph to_graph(const Trace& trace, const Places& places, double cell) {
  ChannelGraph graph;
  graph.cell = cell;
  const std::vector<int> degree = degrees(trace);
  for (std::size_t n = 0; n < trace.nodes.size(); ++n) {
    const Vec2 position = places.centre(trace.nodes[n]);
    graph.nodes.push_back({position, 2 * places.clearance(position), degree[n], 0});
  }
  for (const Trace::Line& line : trace.lines) {
    const ChannelNode& a = graph.nodes[line.a];
    const ChannelNode& b = graph.nodes[line.b];
    ChannelBranch branch{.a = line.a, .b = line.b};
    const int ends = (a.degree == 1) + (b.degree == 1);
    branch.type = line.a == line.b && a.degree == 2 ? BranchType::loop
                  : ends == 2                       ? BranchType::end_end
                  : ends == 1                       ? BranchType::junction_end
                                                    : BranchType::junction_junction;
    branch.line.push_back(a.position);
    for (const SkeletonCell c : line.cells) branch.line.push_back(places.centre(c));
    branch.line.push_back(b.position);
    branch.line = smoothed_line(branch.line);
    branch.length = polyline_length(branch.line);
    measure_widths(branch, a, b, places);
    graph.branches.push_back(std::move(branch));
  }
  number_networks(graph);
  return graph;
}

const char* type_name(BranchType type) {
  constexpr const char* names[] = {"end-end", "junction-end", "junction-junction", "loop"};
  return names[static_cast<int>(type)];
}

}  // namespace

ChannelGraph channel_graph(const Map& map, double cell, const Stop& stop) {
  const Box& bounds = map.bounds();
  if (cell == 0) cell = std::sqrt(bounds.width() * bounds.height() / cells_by_default);
  Mask skeleton = formats::rasterise(map, cell);
  for (std::uint8_t& c : skeleton.cells) c = c == 0;  // walls were set
  const Mask shape(skeleton.width, skeleton.height);
  const Places places(map, shape, cell);
  thin(skeleton, stop);
  if (stop()) return {};
  Trace trace = SkeletonTracer(skeleton).run();
  for (int i = 0; i < max_prunings && !stop() && prune(skeleton, trace, places); ++i) {
    thin(skeleton);
    trace = SkeletonTracer(skeleton).run();
  }
  if (stop()) return {};
  return to_graph(trace, places, cell);
}

std::string branch_table(const ChannelGraph& graph) {
  std::string text =
      "branch,network,type,node_a,node_b,length_um,straight_um,mean_width_um,min_width_um,"
      "max_width_um,narrowest_x_um,narrowest_y_um,a_x_um,a_y_um,b_x_um,b_y_um\n";
  int number = 0;
  for (const ChannelBranch& branch : graph.branches) {
    const Vec2 a = graph.nodes[branch.a].position;
    const Vec2 b = graph.nodes[branch.b].position;
    text += fmt::format("{},{},{},{},{}", ++number, branch.network, type_name(branch.type),
                        branch.a + 1, branch.b + 1);
    for (const double v :
         {branch.length, distance(a, b), branch.mean_width, branch.min_width, branch.max_width,
          branch.narrowest.x, branch.narrowest.y, a.x, a.y, b.x, b.y})
      text += fmt::format(",{:.6g}", v);
    text += '\n';
  }
  return text;
}

std::string node_table(const ChannelGraph& graph) {
  std::string text = "node,network,type,degree,x_um,y_um,width_um\n";
  int number = 0;
  for (const ChannelNode& node : graph.nodes)
    text += fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g}\n", ++number, node.network,
                        node.degree == 0   ? "room"
                        : node.degree == 1 ? "end"
                        : node.degree == 2 ? "loop"
                                           : "junction",
                        node.degree, node.position.x, node.position.y, node.width);
  return text;
}

}  // namespace microswarm::vision
