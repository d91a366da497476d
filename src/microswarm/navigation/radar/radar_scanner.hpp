// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "microswarm/navigation/radar/radar_scan.hpp"
#include "microswarm/navigation/radar/radar_tuning.hpp"

namespace microswarm::navigation {

/// Nearest body in the detection circle.
struct RadarContact {
  std::uint32_t body = 0;
  double distance = 0;  ///< from the swarm's centre to its edge, minus `approach` [µm]
};

/// Fast version of `scan`: collects nearby objects once, then tests all directions in flat loops.
/// Does not allocate once its buffers have grown.
class RadarScanner {
 public:
  explicit RadarScanner(int directions, const RadarTuning& tuning = {});

  int directions() const { return static_cast<int>(ux_.size()); }

  /// Collects the objects in the detection circle; returns the nearest body.
  std::optional<RadarContact> detect(const RadarLook& look, const Snapshot& world);
  /// Heading of the best direction by Eq 9–17, 30, 31 [radar] among what was detected for the same
  /// look, whose safety circle may have changed since. Nothing if all are screened.
  std::optional<double> choose(const RadarLook& look, const Snapshot& world);
  /// Heading of the best retreat if no direction is safe (ours). Of some directions, one or three
  /// steps long, it maximises the sum of the minimum distance to anything along the path and the
  /// distance at its end. Nothing if holding is as good.
  std::optional<double> retreat(const RadarLook& look, const Snapshot& world) const;
  /// For each direction, whether it is not screened: χ_2 of Eq 17 [radar].
  std::vector<bool> kept(const RadarLook& look, const Snapshot& world);

 private:
  struct NearDisc {
    Disc disc;
    double distance;
  };
  struct NearEdge {
    Segment edge;
    std::uint32_t body;
  };
  /// Distances from the swarm's centre to the nearest object, at most r_d [µm].
  struct Outcome {
    double on_path = 0;  ///< minimum along the path
    double at_end = 0;
    double worth() const { return on_path + at_end; }  ///< [µm]
  };

  void note(RadarContact contact);
  void place(const RadarLook& look);
  void screen(const RadarLook& look, const Snapshot& world);
  void screen_by_obstacles(const RadarLook& look, const Snapshot& world);
  void screen_by_walls(const RadarLook& look, const Snapshot& world);
  void measure_distance(Vec2 target);
  void measure_gap(const Snapshot& world);
  std::optional<std::size_t> best(const RadarLook& look, const Snapshot& world);
  Outcome outcome(const RadarLook& look, const Snapshot& world, Vec2 to) const;
  double heading(std::size_t i) const;

  RadarTuning tuning_;
  std::vector<double> ux_, uy_;  ///< directions
  std::vector<double> px_, py_;  ///< predictive swarms
  std::vector<double> room_;     ///< squared distance minus squared reach; negative: screened
  std::vector<double> nearness_, gap_;  ///< terms of Eq 9
  std::optional<RadarContact> nearest_;
  std::vector<NearDisc> discs_;
  std::vector<NearEdge> edges_;
  std::vector<std::uint32_t> bodies_;  ///< near bodies, each once
};

}  // namespace microswarm::navigation
