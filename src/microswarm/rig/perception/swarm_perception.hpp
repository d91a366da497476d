// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "microswarm/formats/images/mask.hpp"
#include "microswarm/navigation/prediction/body_numbers.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/rig/perception/valve_leaves.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"
#include "microswarm/vision/scene/scene_windows.hpp"

namespace microswarm::rig {

/// Expected size in the picture of a swarm with these limits; a smooth swarm must have it at its
/// first detection.
vision::SwarmPrior expected_swarm(const SwarmLimits& limits, const PerceptionParams& params,
                                  const vision::CameraScale& scale);

/// Detects one swarm among moving obstacles, within its reach since the last detection and with
/// about its last size. Position and radius are those of the smallest circle around its outline.
/// Its heading is its last direction of motion. A swarm without texture is recognised at first by
/// the scenario's start and size; a swarm that had texture is never replaced by a smooth blob.
class SwarmPerception : public Perception {
 public:
  /// The swarm starts at `start`; the camera shows the `obstacles` of the scenario.
  SwarmPerception(const PerceptionParams& params, const SwarmLimits& limits, const Map& map,
                  const Pose2& start, const CameraView& view,
                  std::span<const Obstacle> obstacles = {});

  const Detections& process(const formats::Image& picture, double t) override;
  void commanded(const Command& command, double t) override;
  double follow_distance() const override;

 private:
  vision::SeenScene find(const formats::Image& picture, double t);
  vision::SwarmSighting find_beside_walls(const formats::Image& picture,
                                          const vision::SwarmFinderParams& params);
  double reach_px(double t) const;
  vision::SceneParams search(double t) const;
  vision::SwarmPrior prior() const;
  bool is_of_its_size(double radius_px) const;
  void keep_size(const vision::Blob& swarm);
  bool tell_split(const vision::SwarmSighting& sighting);
  bool tell_merger(const vision::Blob& whole, const vision::SeenScene& scene);
  void accept(const vision::Blob& swarm, const vision::SeenScene& scene, double t);
  std::vector<vision::Ring> expected_discs(double t) const;
  bool is_large_or_known(const vision::SeenObstacle& seen,
                         const std::vector<vision::Ring>& expected) const;
  void measure_following(Vec2 position, double t);
  void tell_heading(Vec2 position);

  PerceptionParams params_;
  vision::CameraScale scale_;
  formats::Mask walls_;
  vision::SceneWindows windows_;
  ValveLeaves valves_;
  navigation::BodyNumbers numbers_;
  Vec2 from_;  // position at the last update of the heading
  double heading_;
  SwarmLimits limits_;
  std::optional<Vec2> before_px_;
  std::optional<double> found_;       // time of the last sighting [s]
  std::vector<double> radii_px_;      // of the last sightings, a ring
  std::size_t sightings_ = 0;         // so far
  std::vector<vision::Blob> beside_;  // other blobs at the last sighting
  double texture_ = 0;                // texture of the swarm at that time
  Command command_;
  Detections detections_;
};

}  // namespace microswarm::rig
