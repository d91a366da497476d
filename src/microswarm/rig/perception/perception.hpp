// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/rig/params/perception_params.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"

namespace microswarm::rig {

/// Scale and size of a camera's pictures.
struct CameraView {
  vision::CameraScale scale{};
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
};

/// Why no swarm was found in a picture.
enum class NotFound {
  none,     ///< nothing like it is seen
  far,      ///< what is seen is too far away
  several,  ///< there are several
  size,     ///< what is seen is of another size
  split,    ///< it split into parts
  merged,   ///< it merged with another body
  robots,   ///< too few robots are seen
};
constexpr auto enum_names(NotFound) {
  return std::array<std::pair<NotFound, std::string_view>, 7>{{{NotFound::none, "none"},
                                                               {NotFound::far, "far"},
                                                               {NotFound::several, "several"},
                                                               {NotFound::size, "size"},
                                                               {NotFound::split, "split"},
                                                               {NotFound::merged, "merged"},
                                                               {NotFound::robots, "robots"}}};
}

/// Detections in one picture.
struct Detections {
  std::optional<SwarmPose> swarm{};
  std::vector<Vec2> robots{};  ///< individually tracked robots; the order never changes
  std::vector<Body> moving{};  ///< obstacles with persistent numbers; leaves of a valve share one
  std::optional<NotFound> not_found{};  ///< why no swarm was found; empty before the first picture
  std::vector<double> parts{};    ///< radii of the parts after a split or before a merger [µm]
  int unseen = 0;                 ///< robots without a spot, neither their own nor that of a pile
  Vec2 commanded{};               ///< commanded displacement since the last picture [µm]
  double commanded_distance = 0;  ///< commanded distance since the last picture [µm]
  double followed_distance = 0;   ///< observed displacement along it [µm]; negative: opposite
  double across_distance = 0;     ///< observed displacement to its left [µm]
};

/// Interface of a rig's image processing, picture by picture, in world coordinates. Walls are those
/// of the scenario's map.
class Perception {
 public:
  virtual ~Perception() = default;
  /// Processes the next grey picture, taken at `t` [s]. Valid until the next call.
  virtual const Detections& process(const formats::Image& picture, double t) = 0;
  /// Takes the command that drives the swarm from time `t` [s] on.
  virtual void commanded(const Command& command, double t) = 0;
  /// Commanded distance over which following can be judged [µm].
  virtual double follow_distance() const = 0;
};

/// Navigator observation of the detections. `sight` and `world` must outlive it.
Observation to_observation(const Detections& sight, std::shared_ptr<const Snapshot> world,
                           double now, double seen);

/// Creates the perception of a scenario: for one swarm among obstacles, or for robots. The
/// camera shows the scenario's obstacles: a deforming channel among them means that walls move, and
/// leaves are joined at the positions of valves.
std::unique_ptr<Perception> make_perception(const PerceptionParams& params,
                                            const experiment::Scenario& scenario, const Map& map,
                                            std::span<const Vec2> starts, const CameraView& view);

}  // namespace microswarm::rig
