// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/body_numbers.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/geometry/point_grid.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"

namespace microswarm::navigation {
namespace {

constexpr double memory = 1;       // [s] for which a hidden body is remembered
constexpr double smoothing = 0.3;  // weight of the newest velocity
/// Maximum number of known bodies within reach of a body that are considered, nearest first.
constexpr std::size_t candidates = 64;
constexpr double preference = 1e-12;  // of squared distances

/// Adds the pairs of a body at `position`, row `row`, with the nearest expected bodies within
/// reach, in ascending order of distance.
class Pairing {
 public:
  Pairing(std::span<const Vec2> expected, double reach)
      : expected_(expected), reach_(reach), grid_(bounding_box(expected).grown(reach)) {
    if (expected.size() > candidates)
      for (const Vec2 position : expected) grid_.add(position);
  }

  void add(int row, Vec2 position, std::vector<AssignmentEdge>& edges) {
    find_near(position);
    const std::size_t first = edges.size();
    for (const std::uint32_t k : near_) {
      const double off = squared_norm(position - expected_[k]);
      if (off <= reach_ * reach_) edges.push_back({row, static_cast<int>(k), off});
    }
    if (edges.size() - first <= candidates) return;
    const auto begin = edges.begin() + static_cast<std::ptrdiff_t>(first);
    // Of coinciding bodies each prefers another one.
    for (auto edge = begin; edge != edges.end(); ++edge)
      edge->cost += preference * reach_ * reach_ * std::abs(edge->column - row);
    std::nth_element(begin, begin + candidates, edges.end(), [](const auto& a, const auto& b) {
      return std::pair(a.cost, a.column) < std::pair(b.cost, b.column);
    });
    edges.resize(first + candidates);
    std::sort(begin, edges.end(), [](const auto& a, const auto& b) { return a.column < b.column; });
  }

 private:
  void find_near(Vec2 position) {
    near_.clear();
    if (expected_.size() <= candidates) {
      near_.resize(expected_.size());
      std::iota(near_.begin(), near_.end(), 0u);
      return;
    }
    // The radius grows until it holds enough candidates, so that few are tested in a crowd.
    for (double share = 1.0 / 64; near_.size() < candidates; share *= 2) {
      near_.clear();
      grid_.within(position, std::min(share, 1.0) * reach_, near_);
      if (share >= 1) break;
    }
  }

  std::span<const Vec2> expected_;
  double reach_;
  PointGrid grid_;
  std::vector<std::uint32_t> near_;
};

}  // namespace

void BodyNumbers::number(std::vector<Body>& bodies, double t, const Stop& stop) {
  std::erase_if(known_, [&](const Known& k) { return t - k.t > memory; });
  std::vector<Vec2> expected;
  expected.reserve(known_.size());
  for (const Known& k : known_) expected.push_back(k.centre + (t - k.t) * k.velocity);
  Pairing pairing(expected, reach_);
  std::vector<AssignmentEdge> edges;
  for (std::size_t b = 0; b < bodies.size() && !stop(); ++b)
    pairing.add(static_cast<int>(b), enclosing_disc(bodies[b]).centre, edges);
  const auto known_numbers =
      assignment_.solve(static_cast<int>(bodies.size()), static_cast<int>(known_.size()), edges,
                        reach_ * reach_, stop);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Vec2 centre = enclosing_disc(bodies[b]).centre;
    const double radius = std::visit(Overloaded{[](const Disc& disc) { return disc.radius; },
                                                [](const Polygon&) { return 0.0; }},
                                     bodies[b].shape);
    if (!known_numbers[b]) {
      bodies[b].obstacle = next_++;
      known_.push_back({.number = bodies[b].obstacle,
                        .radius = radius,
                        .centre = centre,
                        .velocity = {},
                        .t = t});
      continue;
    }
    Known& known = known_[static_cast<std::size_t>(*known_numbers[b])];
    bodies[b].obstacle = known.number;
    if (t > known.t) {
      const Vec2 moved = (centre - known.centre) / (t - known.t);
      known.velocity += (known.pictures > 1 ? smoothing : 1) * (moved - known.velocity);
      ++known.pictures;
    }
    known.radius = radius;
    known.centre = centre;
    known.t = t;
  }
}

std::vector<Disc> BodyNumbers::expected_discs(double t) const {
  std::vector<Disc> discs;
  for (const Known& known : known_)
    if (known.radius > 0 && t - known.t <= memory)
      discs.push_back({known.centre + (t - known.t) * known.velocity, known.radius});
  return discs;
}

}  // namespace microswarm::navigation
