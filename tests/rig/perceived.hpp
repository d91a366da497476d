// SPDX-License-Identifier: Apache-2.0
// What tests of perception share: a map, a camera's view, settings.
#pragma once

#include <memory>

#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/rig/simulation/microscope.hpp"

namespace microswarm::test {

inline std::shared_ptr<const Map> channel() {
  return std::make_shared<const Map>(
      Box{{0, 0}, {1200, 800}},
      std::vector<Polygon>{{{{0, 0}, {1200, 0}, {1200, 100}, {0, 100}}, {}}});
}

inline Box bounding_box(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body.shape))
    return Box{disc->centre, disc->centre}.grown(disc->radius);
  return microswarm::bounding_box(std::get<Polygon>(body.shape));
}

inline rig::CameraView session_view(const rig::Microscope& m) {
  return {m.scale(), m.width(), m.height()};
}

inline rig::PerceptionParams eye_params() {
  rig::PerceptionParams p;
  p.edge = 1.5;
  p.scene.swarm.look.min_contrast = 80;
  p.scene.swarm.look.gap = 4;
  return p;
}

}  // namespace microswarm::test
