// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/vascular.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "microswarm/world/obstacles/clip.hpp"

namespace microswarm::scenes {
namespace {

/// Nodes per µm² of free space, as in the T-junction.
constexpr double nodes_per_area = 4000.0 / 1400;

Polygon round(Disc disc) {
  Polygon polygon;
  constexpr int corners = 16;
  for (int i = 0; i < corners; ++i) {
    polygon.outer.push_back(disc.centre + disc.radius * unit_vector(2 * pi * i / corners));
  }
  return polygon;
}

Polygon channel(Disc a, Disc b) {
  const Vec2 along = b.centre - a.centre;
  const Vec2 side = perpendicular(along / norm(along));
  return {{a.centre - a.radius * side, b.centre - b.radius * side, b.centre + b.radius * side,
           a.centre + a.radius * side},
          {}};
}

double free_area(const Vascular& v) {
  double sum = v.bounds.width() * v.bounds.height();
  for (const Polygon& wall : v.walls) sum -= area(wall);
  return sum;
}

/// A position on the generator's grid.
struct Place {
  int column;
  int row;
};

/// Grows the random network. The root, joint 0, keeps one channel only, so it is a dead end.
class Generator {
 public:
  Generator(const VascularShape& shape, Rng& rng) : shape_(shape), rng_(rng) {
    columns_ = std::max(2, static_cast<int>(shape.width / shape.spacing));
    rows_ = std::max(2, static_cast<int>(shape.height / shape.spacing));
    graph_.bounds = {{0, 0}, {shape.width, shape.height}};
    joint_at_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), absent);
  }

  ChannelGraph grow() {
    const auto column = static_cast<int>(rng_.below(static_cast<std::uint64_t>(columns_)));
    const auto row = static_cast<int>(rng_.below(static_cast<std::uint64_t>(rows_)));
    open_joint({column, row}, 0);
    // Pick any open channel, so the tree grows evenly.
    while (!open_.empty()) {
      const std::size_t pick = rng_.below(open_.size());
      const auto [from, position] = open_[pick];
      open_[pick] = open_.back();
      open_.pop_back();
      std::uint32_t& joint = at(position);
      if (joint == absent) {
        if (joints() > 2 && rng_.uniform() < shape_.missing) {
          joint = left_out;
        } else {
          open_joint(position, from);
        }
      } else if (joint != left_out && joint != 0 && from != 0 && !is_joined(from, joint) &&
                 rng_.uniform() < shape_.loops) {
        graph_.channels.push_back({from, joint});
      }
    }
    return std::move(graph_);
  }

 private:
  static constexpr std::uint32_t absent = ~0u;
  static constexpr std::uint32_t left_out = ~0u - 1;
  struct Open {
    std::uint32_t from;
    Place to;
  };

  std::uint32_t joints() const { return static_cast<std::uint32_t>(graph_.joints.size()); }
  std::uint32_t& at(Place p) {
    return joint_at_[static_cast<std::size_t>(p.row) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(p.column)];
  }
  bool is_joined(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(graph_.channels.begin(), graph_.channels.end(), [&](const auto& c) {
      return (c.first == a && c.second == b) || (c.first == b && c.second == a);
    });
  }

  void open_joint(Place position, std::uint32_t from) {
    const std::uint32_t joint = joints();
    at(position) = joint;
    const Vec2 cell{shape_.width / columns_, shape_.height / rows_};
    const double dx = rng_.uniform(-shape_.wander, shape_.wander);
    const double dy = rng_.uniform(-shape_.wander, shape_.wander);
    const double half = rng_.uniform(shape_.min_half, shape_.max_half);
    const Vec2 centre{(position.column + 0.5 + dx) * cell.x, (position.row + 0.5 + dy) * cell.y};
    graph_.joints.push_back({centre, half});
    if (joint != from) graph_.channels.push_back({from, joint});
    const Place around[] = {{position.column + 1, position.row},
                            {position.column - 1, position.row},
                            {position.column, position.row + 1},
                            {position.column, position.row - 1}};
    std::vector<Open> open;
    for (const Place p : around) {
      if (p.column < 0 || p.row < 0 || p.column >= columns_ || p.row >= rows_) continue;
      open.push_back({joint, p});
    }
    if (joint == 0) open = {open[rng_.below(open.size())]};
    open_.insert(open_.end(), open.begin(), open.end());
  }

  const VascularShape& shape_;
  Rng& rng_;
  int columns_;
  int rows_;
  ChannelGraph graph_;
  std::vector<std::uint32_t> joint_at_;
  std::vector<Open> open_;
};

}  // namespace

// Retries networks that stop growing early; returns the largest if none is large enough.
ChannelGraph random_channels(const VascularShape& shape, Rng& rng) {
  constexpr int max_tries = 20;
  const double positions =
      std::floor(shape.width / shape.spacing) * std::floor(shape.height / shape.spacing);
  ChannelGraph best;
  for (int i = 0; i < max_tries; ++i) {
    ChannelGraph graph = Generator(shape, rng).grow();
    if (graph.joints.size() > best.joints.size()) best = std::move(graph);
    if (static_cast<double>(best.joints.size()) >= 0.8 * (1 - shape.missing) * positions) break;
  }
  return best;
}

std::vector<Polygon> graph_walls(const ChannelGraph& graph) {
  std::vector<Polygon> channels;
  for (const Disc& joint : graph.joints) channels.push_back(round(joint));
  for (const auto& [a, b] : graph.channels) {
    channels.push_back(channel(graph.joints[a], graph.joints[b]));
  }
  return difference(graph.bounds, channels);
}

Vascular generated_vascular_network() {
  VascularShape shape;
  shape.width = 400;
  shape.height = 314;
  shape.spacing = 44;
  shape.min_half = 5;
  shape.max_half = 8;
  shape.missing = 0.1;
  shape.loops = 0.25;
  Rng rng(24, Purpose::scene);
  Vascular v = random_vascular(shape, rng);
  v.name = "generated_vascular_network";
  v.nodes = 40'000;
  return v;
}

Vascular random_vascular(const VascularShape& shape, Rng& rng) {
  const ChannelGraph graph = random_channels(shape, rng);
  Vascular v;
  v.name = "random_vascular";
  v.bounds = graph.bounds;
  v.walls = graph_walls(graph);
  v.width = shape.min_half + shape.max_half;
  // Inside the dead end, as in the T-junction: 3 of 10 widths from its wall.
  const Disc end = graph.joints[0];
  const Vec2 out = end.centre - graph.joints[graph.channels[0].second].centre;
  v.goal = end.centre + (0.4 * end.radius / norm(out)) * out;
  v.nodes = static_cast<int>(nodes_per_area * free_area(v) * maths::power(10 / v.width, 2));
  return v;
}

}  // namespace microswarm::scenes
