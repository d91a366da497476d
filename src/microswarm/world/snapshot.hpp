// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// World at one moment: the map and the moving bodies at their positions. Planners and navigators
/// see worlds only as snapshots. Cheap to construct, since the map is shared; queries are
/// thread-safe.
class Snapshot {
 public:
  explicit Snapshot(std::shared_ptr<const Map> map, double time = 0, std::vector<Body> moving = {});

  /// The walls alone. The map is not copied and must outlive the snapshot.
  static Snapshot of(const Map& map) {
    return Snapshot(std::shared_ptr<const Map>(std::shared_ptr<void>(), &map));
  }

  /// Time of the snapshot [s].
  double time() const { return time_; }
  const Map& map() const { return *map_; }
  const std::shared_ptr<const Map>& shared_map() const { return map_; }
  const BodySet& moving() const { return moving_; }
  const Box& bounds() const { return map_->bounds(); }

  /// Distance [µm] to the nearest wall, border or body; 0 inside one or outside. Exact.
  double clearance(Vec2 p) const;
  /// Distance [µm] to the nearest wall or body, without the border: D_obs of Eq 4c [drrt].
  double obstacle_clearance(Vec2 p) const;
  bool is_free(Vec2 p, double r) const {
    // Whether bodies move is predictable; whether the place is free is not.
    if (moving_.empty()) return map_->is_free(p, r);
    return map_->is_free(p, r) && moving_.is_free(p, r);
  }
  /// The same for many places at once, which is quicker: free[i] is 1 if places[i] is free, else 0.
  /// `free` is as long as `positions`.
  void are_free(std::span<const Vec2> positions, double r, std::span<std::uint8_t> free) const;
  bool is_free(Segment s, double r) const {
    if (moving_.empty()) return map_->is_free(s, r);
    return map_->is_free(s, r) && moving_.is_free(s, r);
  }
  /// Whether the disc of radius r > 0 around `p` is free by one lookup in the map; if false, it may
  /// be free or not.
  bool is_open(Vec2 p, double r) const {
    return map_->field().lower(p) >= r && (moving_.empty() || moving_.is_free(p, r));
  }
  /// Whether every segment of the polyline is free with clearance r. Short curves far from walls
  /// cost one lookup.
  bool is_free(std::span<const Vec2> polyline, double r) const;
  /// Contents of a detection circle: Eq 1–2 [drrt].
  Survey survey(Disc circle, const Stop& stop = {}) const;
  /// Readable reason why `p` is not free with clearance r: "is 12 µm inside wall 3", "is 7 µm from
  /// obstacle 1, needs 40 µm", "is outside the map (0..2000 × 0..1000 µm)"; empty if free.
  std::string blocked_reason(Vec2 p, double r) const;

 private:
  std::shared_ptr<const Map> map_;
  double time_ = 0;
  BodySet moving_;
};

}  // namespace microswarm
