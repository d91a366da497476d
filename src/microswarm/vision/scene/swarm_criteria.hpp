// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/vision/scene/scene_finder.hpp"

namespace microswarm::vision {

/// Criteria of a swarm.
enum class SwarmCriterion {
  min_radius,
  max_radius,
  texture,   ///< it is smooth, and there are swarms of texture, or smooth ones do not count
  alone,     ///< it is smooth, and so are others that could be the swarm
  whole,     ///< it is smooth, and cut by the picture's edge or a wall
  expected,  ///< it is smooth, and not of the size that the swarm has
  distance,  ///< from the swarm's last position
  rival,     ///< its area beside that of the largest candidate
  contrast,
  tone,
};
constexpr auto enum_names(SwarmCriterion) {
  return std::array<std::pair<SwarmCriterion, std::string_view>, 10>{
      {{SwarmCriterion::min_radius, "min_radius"},
       {SwarmCriterion::max_radius, "max_radius"},
       {SwarmCriterion::texture, "texture"},
       {SwarmCriterion::alone, "alone"},
       {SwarmCriterion::whole, "whole"},
       {SwarmCriterion::expected, "expected_radius"},
       {SwarmCriterion::distance, "distance"},
       {SwarmCriterion::rival, "rival"},
       {SwarmCriterion::contrast, "contrast"},
       {SwarmCriterion::tone, "tone"}}};
}

/// A blob that is not the swarm, and the first criterion that it fails.
struct NotSwarm {
  Blob blob{};
  SwarmCriterion criterion = SwarmCriterion::texture;
  double value = 0;           ///< of the blob, in the criterion's unit; 0 for a tone
  double limit = 0;           ///< that it misses
  std::string_view key = {};  ///< of the setting, from `scene` on
};

/// Why the blobs of a picture are not the swarm, for the scene that `find_scene` found with the
/// same arguments. Where no swarm was found, also what is too faint or of the other tone.
std::vector<NotSwarm> why_not_swarm(const SeenScene& scene, const formats::Image& picture,
                                    const SceneParams& params = {}, const SwarmPrior& prior = {},
                                    const formats::Mask* walls = nullptr);

/// The criterion with value, limit and key, such as "texture 0.0 < 5
/// (scene.swarm.look.min_texture)".
std::string reason(const NotSwarm& blob);
/// The same in a few characters.
std::string short_reason(const NotSwarm& blob);

}  // namespace microswarm::vision
