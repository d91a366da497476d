// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/rig/simulation/rig_simulator.hpp"
#include "microswarm/rig/watch/sight_monitor.hpp"

namespace microswarm::rig {

/// A complete simulated rig, as fast as possible. A command becomes a field, the field becomes
/// currents, RigSimulator applies them, and the navigator receives the detections in the
/// microscope's picture. Like a run, it aims the coils at the detected swarm, and SightMonitor ends
/// it.
class SimulatedRig : public Plant {
 public:
  /// `driver` must outlive the plant; if it is null, the coils are simulated. `trial` selects the
  /// random streams. Throws InputError if rig and scenario do not fit.
  SimulatedRig(const experiment::Scenario& scenario, const World& world, Rig rig,
               std::uint32_t trial = 0, actuation::CoilDriver* driver = nullptr);

  Observation observe() override;
  void apply(const Command& command, double dt) override;
  bool set_obstacles(const std::vector<Obstacle>& obstacles) override {
    return simulator_.set_obstacles(obstacles);
  }
  std::string_view fault() const override { return fault_; }
  std::optional<GroundTruth> ground_truth() const override { return simulator_.ground_truth(); }

  /// Sets the frequency of the field [Hz], see FieldGenerator::set_frequency.
  void set_field_frequency(double frequency) { controller_.set_frequency(frequency); }

  /// The picture of the last observation.
  const formats::Image& picture() const { return *picture_; }
  const Detections& detections() const { return *detections_; }
  const actuation::CoilOutput& coils() const { return controller_.output(); }
  /// Place among the coils at which the field is made [µm].
  const Eigen::Vector3d& aim() const { return controller_.place(); }
  /// Lowest scale of the currents so far, imposed by the limits of the coils.
  double min_scale() const { return min_scale_; }
  /// Sets the temperatures of the coils [°C].
  void warm(const Eigen::VectorXd& temperatures) { controller_.warm(temperatures); }

  /// State of the pictures: light, focus, map, unseen swarms.
  PictureState picture_state() const { return sight_.watch().state(); }
  /// Notes about the pictures that came up since the last call, one line each.
  std::vector<std::string> take_notes() { return sight_.watch().take_notes(); }

 private:
  void look_at_map(double seen);

  const Rig rig_;
  std::unique_ptr<actuation::CoilDriver> simulated_coils_;
  actuation::CoilDriver& driver_;
  actuation::CoilController controller_;
  RigSimulator simulator_;
  std::shared_ptr<const Map> map_;
  std::unique_ptr<Perception> perception_;
  SightMonitor sight_;
  std::optional<PictureRegistration> registration_;
  double look_due_ = 0;  // [s]
  std::string fault_;
  double min_scale_ = 1;
  const formats::Image* picture_ = nullptr;
  Detections unseen_;  // before the first picture
  const Detections* detections_ = &unseen_;
};

/// Simulated coils with the properties of the rig's driver, of any kind; opens no device.
std::unique_ptr<actuation::CoilDriver> simulated_coils(const Rig& rig);

}  // namespace microswarm::rig
