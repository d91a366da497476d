// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/simulated_rig.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/infinity.hpp"

namespace microswarm::rig {

SimulatedRig::SimulatedRig(const experiment::Scenario& scenario, const World& world, Rig rig,
                           std::uint32_t trial, actuation::CoilDriver* driver)
    : rig_(std::move(rig)),
      simulated_coils_(driver ? nullptr : simulated_coils(rig_)),
      driver_(driver ? *driver : *simulated_coils_),
      controller_(rig_.system, rig_.params.field, driver_,
                  scenario.start ? scenario.start->heading : 0),
      simulator_(scenario, world, rig_, trial),
      map_(world.map),
      perception_(make_perception(rig_.params.perception, scenario, *map_,
                                  scenario.robots ? scenario.robots->starts : std::vector<Vec2>{},
                                  simulator_.camera())),
      sight_(rig_.params.safety, rig_.params.delay) {
  deadman(rig_, scenario.tick);
}

Observation SimulatedRig::observe() {
  const RigSimulator::Shot shot = simulator_.capture();
  picture_ = &simulator_.render(shot);
  detections_ = &perception_->process(*picture_, shot.seen);
  look_at_map(shot.seen);
  sight_.take(*picture_, *detections_, simulator_.camera(), shot.seen,
              perception_->follow_distance());
  if (fault_.empty()) fault_ = sight_.fault(shot.now).why;
  if (!fault_.empty()) controller_.stop();
  return to_observation(*detections_,
                        std::make_shared<const Snapshot>(map_, shot.seen, detections_->moving),
                        shot.now, shot.seen);
}

/// Looks at the map in the first picture, then once a second, and at once when it is in doubt.
void SimulatedRig::look_at_map(double seen) {
  constexpr double period = 1;  // [s]
  const double limit = rig_.params.safety.max_map_shift_px;
  if (!registration_) {
    registration_.emplace(*map_, simulator_.camera());
    const PictureFit first = registration_->fit(*picture_, true);
    if (!first.unsure.empty())
      registration_->keep_still(*picture_, moving_rings(*detections_, simulator_.camera().scale));
  } else if (seen < look_due_) {
    return;
  }
  sight_.watch().take(rig::look_at_map(*registration_, *picture_, limit > 0 ? limit : infinity),
                      seen);
  look_due_ = sight_.watch().is_in_doubt() ? seen : seen + period;
}

void SimulatedRig::apply(const Command& command, double dt) {
  const auto pieces = static_cast<int>(std::ceil(dt * rig_.params.drive_rate - 1e-9));
  const double piece = dt / pieces;
  const Vec2 position =
      detections_->swarm ? detections_->swarm->pose.position : map_->bounds().centre();
  controller_.command(command);
  controller_.aim(place_among_coils(rig_.system, *map_, position));
  perception_->commanded(command, simulator_.ground_truth().now);
  simulator_.start_trajectory();
  for (int i = 0; i < pieces; ++i) {
    if (fault_.empty()) min_scale_ = std::min(min_scale_, controller_.advance(piece).scale);
    simulator_.pass(driver_.report().currents, piece);
  }
}

std::unique_ptr<actuation::CoilDriver> simulated_coils(const Rig& rig) {
  return std::make_unique<actuation::SimulatedCoilDriver>(
      channel_count(rig.params, rig.system), driver_full_scale(rig.params), coil_input(rig.params));
}

}  // namespace microswarm::rig
