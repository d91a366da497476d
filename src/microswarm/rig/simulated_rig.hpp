// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "microswarm/actuation/coil_controller.hpp"
#include "microswarm/rig/eye.hpp"
#include "microswarm/rig/field_response.hpp"
#include "microswarm/rig/microscope.hpp"
#include "microswarm/rig/rig_params.hpp"

namespace microswarm {

/// A whole rig in simulation: a command becomes a field, the field currents, the currents the field
/// where the swarm truly is, and that field drives the swarm of the scenario's kinematic plant.
/// What it looks like is drawn as a microscope picture, and the navigator is told what is seen in
/// it. The scenario's sensor noise is left out: pictures have their own.
class SimulatedRig : public Plant {
 public:
  /// The rig and, when given, the driver outlive it; without one the coils are simulated. `trial`
  /// chooses the streams. Throws InputError when rig and scenario do not go together.
  SimulatedRig(const Scenario& scenario, World world, const Rig& rig, std::uint32_t trial = 0,
               CoilDriver* driver = nullptr);

  Observation observe() override;
  void apply(const Command& command, double dt) override;
  std::optional<Truth> truth() const override;

  /// The picture of the last observation.
  const Image& picture() const { return *picture_; }
  const Sight& sight() const { return *sight_; }
  const CoilOutput& coils() const { return controller_.output(); }

 private:
  Command field_command(double dt);

  const Rig& rig_;
  bool robots_;
  std::unique_ptr<CoilDriver> simulated_coils_;
  CoilDriver& driver_;
  CoilController controller_;
  FieldResponse response_;
  std::unique_ptr<Plant> physics_;
  std::shared_ptr<const Map> map_;
  Microscope microscope_;
  std::unique_ptr<Eye> eye_;
  const Image* picture_ = nullptr;
  const Sight* sight_ = nullptr;
  std::optional<Snapshot> seen_world_;
  std::vector<TimedPose> swept_;
};

/// Throws InputError when the rig cannot drive the scenario's swarm as fast as it is meant to go,
/// or sends its currents too seldom for its field; `where` knows the scenario's keys.
void check(const RigParams& rig, const Scenario& scenario, const Places& where = {});

}  // namespace microswarm
