// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/swarm/robots/contact_rule.hpp"
#include "microswarm/swarm/robots/wall_faces.hpp"

namespace microswarm {

/// Point robots, which do not block each other. Structure of arrays in single precision [µm],
/// relative to the centre of the stepper's map.
struct Robots {
  Vec2 origin{};
  std::vector<float> x{};
  std::vector<float> y{};

  std::size_t size() const { return x.size(); }
  /// Position of robot i in the map's coordinates.
  Vec2 position(std::size_t i) const {
    return origin + Vec2{static_cast<double>(x[i]), static_cast<double>(y[i])};
  }
  std::vector<Vec2> positions() const {
    std::vector<Vec2> all(size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = position(i);
    return all;
  }
};

/// Moves point robots that all receive the same input and meet walls: Alg 2 [global], Eq 1
/// [gather]. No robot ever leaves the free space. Immutable after construction, shared by threads.
class RobotStepper {
 public:
  /// `reach` [µm] is the maximum length of a move made at once; longer moves are split. It should
  /// be about the most frequent step length.
  RobotStepper(const Map& map, double reach);

  /// Robots at these positions, which should be at least `guard()` from every wall.
  Robots place(std::span<const Vec2> positions) const;
  /// Moves every robot by `move` [µm] as far as the rule allows. Uses the widest vectors of the
  /// machine; the result has the same bits as `moved` on all machines.
  void step(Robots& robots, Vec2 move, ContactRule rule) const;
  /// End position of a robot at `p`: scalar form of `step`.
  PointF moved(PointF p, PointF move, ContactRule rule) const;
  /// End positions of a robot at `p` after each of these moves, by vectors.
  void moved(PointF p, std::span<const PointF> moves, ContactRule rule,
             std::span<PointF> ends) const;

  /// Distance [µm] that robots keep from walls; they stop at twice this distance.
  double guard() const { return static_cast<double>(faces_.guard()); }
  const WallFaces& faces() const { return faces_; }
  PointF relative(Vec2 p) const;

 private:
  WallFaces faces_;
};

}  // namespace microswarm
