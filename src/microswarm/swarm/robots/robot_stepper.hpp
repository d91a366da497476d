// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/swarm/robots/contact_rule.hpp"
#include "microswarm/swarm/robots/wall_faces.hpp"

namespace microswarm {

/// Point robots, which do not block each other: a structure of arrays in single precision [µm],
/// relative to the middle of the stepper's map.
struct Robots {
  Vec2 origin;
  std::vector<float> x;
  std::vector<float> y;

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

/// Moves point robots that all get the same input and meet walls: Alg 2 [global], Eq 1 [gather]. No
/// robot ever leaves the free space. Immutable after building, shared by threads.
class RobotStepper {
 public:
  /// `reach` [µm] is the move that is made in one go; longer ones are made in pieces. It should be
  /// about the step that is used most.
  RobotStepper(const Map& map, double reach);

  /// Robots at these places. They should be at least `guard()` from every wall.
  Robots place(std::span<const Vec2> places) const;
  /// Moves every robot by `move` [µm] as far as the rule lets it. Uses the widest vectors of the
  /// machine it runs on; the bits are those of `moved` on any of them.
  void step(Robots& robots, Vec2 move, ContactRule rule) const;
  /// Where a robot at `p` gets: the plain form of `step`.
  PointF moved(PointF p, PointF move, ContactRule rule) const;

  /// Robots keep this [µm] from walls that they drive at, and twice as much where they stop.
  double guard() const { return static_cast<double>(faces_.guard()); }
  const WallFaces& faces() const { return faces_; }
  PointF relative(Vec2 p) const;

 private:
  WallFaces faces_;
};

}  // namespace microswarm
