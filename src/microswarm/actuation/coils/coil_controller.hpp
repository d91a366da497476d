// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/drivers/coil_drive.hpp"
#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "microswarm/actuation/field/field_generator.hpp"

namespace microswarm {

/// What went to the coils last.
struct CoilOutput {
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();  ///< field [mT]
  Eigen::VectorXd currents;                          ///< sent, one a coil [A]
  double scale = 1;                                  ///< of the command, by the limits
  bool reached = true;                               ///< these coils can make such a field at all
  DriveStatus status = DriveStatus::driven;
};

/// From a navigator's commands to currents in coils: the field goes on from what it was, the least
/// currents make it where the swarm is (Eq 4 [global]), no limit is broken, the driver sends them.
/// Whoever destroys one leaves the coils without current.
class CoilController {
 public:
  /// Both outlive it. Throws InputError when the system has more coils than the driver has
  /// channels.
  CoilController(const CoilSystem& system, const FieldGeneratorParams& field, CoilDriver& driver,
                 double heading);
  CoilController(const CoilController&) = delete;
  CoilController& operator=(const CoilController&) = delete;
  ~CoilController();

  /// The command from now on.
  void command(const Command& command) { generator_.command(command); }
  /// Where the field is meant to be [µm].
  void aim(const Eigen::Vector3d& place);
  /// Lets `dt` seconds pass and sends the currents for what is then. To be called far more often
  /// than the field turns, and within the device's watchdog time.
  const CoilOutput& advance(double dt);
  /// All currents to zero; false when the device did not confirm it. The next advance begins anew
  /// with the field as it was.
  bool stop() noexcept;

  const CoilOutput& output() const { return output_; }
  /// What is aimed at [µm].
  const Eigen::Vector3d& place() const { return place_; }
  const FieldGenerator& generator() const { return generator_; }
  /// What currents make at the place that is aimed at.
  const Actuation& actuation() const { return actuation_; }

 private:
  const CoilSystem& system_;
  CoilDriver& driver_;
  FieldGenerator generator_;
  CoilDrive drive_;
  Eigen::Vector3d place_;
  Actuation actuation_;
  std::vector<double> channels_;
  CoilOutput output_;
};

}  // namespace microswarm
