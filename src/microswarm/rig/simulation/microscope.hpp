// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/contracts/observation.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/rig/params/microscope_params.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"

namespace microswarm::rig {

/// Draws microscope pictures of a simulated world: grey, y down, the map with a margin around it.
class Microscope {
 public:
  /// `seed` determines the swarm's particles and the noise.
  Microscope(const MicroscopeParams& params, const Map& map, std::uint64_t seed,
             std::uint32_t trial);

  /// The scale that the rig is given; shift, turn and scale error of the parameters are not in it.
  const vision::CameraScale& scale() const { return scale_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// Draws a swarm, robots, or both, under the light of the snapshot's time. Faults of the camera
  /// begin by the time `t` [s]; none: the snapshot's. Valid until the next call.
  const formats::Image& look(const Snapshot& world, const std::optional<SwarmPose>& swarm,
                             std::span<const Vec2> robots, std::optional<double> t = std::nullopt);

 private:
  void draw_body(const Body& body);
  void draw_polygon(const Polygon& polygon);
  void draw_swarm(const SwarmPose& swarm);
  void draw_disc(Vec2 at_px, double radius_px, double depth);
  void expose(double t);
  std::vector<float> ground_of(const Map& map, const vision::CameraScale& scale) const;
  vision::CameraScale moved_scale() const;

  MicroscopeParams params_;
  vision::CameraScale scale_;
  vision::CameraScale drawn_;        // the true one
  std::vector<float> moved_ground_;  // once it has moved; empty if it never does
  int width_;
  int height_;
  Rng rng_;
  std::vector<float> ground_;    // fraction of the light transmitted by the walls
  std::vector<float> lamp_;      // grey of the light without absorption
  std::vector<float> grain_;     // precomputed noise; every picture uses another part
  std::vector<Vec2> particles_;  // in a swarm of radius 1
  std::vector<float> view_;
  formats::Image picture_;
};

}  // namespace microswarm::rig
