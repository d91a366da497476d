// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "microswarm/actuation/field/field_generator.hpp"

namespace microswarm::actuation {

/// The last output to the coils.
struct CoilOutput {
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();  ///< commanded field [mT]
  Eigen::VectorXd currents{};                        ///< sent currents, one per coil [A]
  double scale = 1;                                  ///< scale of the command imposed by the limits
  bool reached = true;                               ///< the coils can produce the commanded field
  DriveStatus status = DriveStatus::driven;
  double device_scale = 1;         ///< by the device's own limits, as last acknowledged
  Eigen::VectorXd acknowledged{};  ///< currents that the device last acknowledged [A]
  Eigen::VectorXd temperatures{};  ///< of the coils, by their thermal model and probes [°C]
  std::string probe_trouble{};     ///< see DeviceReport::probe_trouble
};

/// Setpoint of the coils: a navigator's command, a constant field at the target position [mT],
/// or the currents [A], one per coil.
using Setpoint = std::variant<Command, Eigen::Vector3d, Eigen::VectorXd>;

/// Converts setpoints to coil currents. The field of commands changes continuously. The currents of
/// a field are the minimum-norm solution at the target position (Eq 4 [global]). Currents are
/// scaled to respect all limits, where a coil is as warm as its model or its probe says, whichever
/// is more, and sent by the driver; those of commands as a waveform, to a
/// device that makes them. The destructor sets all currents to zero, unless the device confirmed
/// zero after the last output.
class CoilController {
 public:
  /// `system` and `driver` must outlive the controller. Throws InputError if the system has more
  /// coils than the driver has channels.
  CoilController(const CoilSystem& system, const FieldGeneratorParams& field, CoilDriver& driver,
                 double heading);
  CoilController(const CoilController&) = delete;
  CoilController& operator=(const CoilController&) = delete;
  ~CoilController();

  /// Sets the setpoint; it is a command that keeps `heading` at the start.
  void command(Setpoint setpoint);
  /// Sets the frequency of the field of commands [Hz], see FieldGenerator::set_frequency.
  void set_frequency(double frequency) { generator_.set_frequency(frequency); }
  /// Sets the temperatures of the coils [°C].
  void warm(const Eigen::VectorXd& temperatures) { amplifiers_.warm(temperatures); }
  const Eigen::VectorXd& temperatures() const { return amplifiers_.temperatures(); }  ///< [°C]
  /// Sets the position at which the field is produced [µm].
  void aim(const Eigen::Vector3d& position);
  /// Advances time by `dt` seconds and sends `share` of the currents for the new time. Call it much
  /// faster than the field turns, and within the device's watchdog time.
  const CoilOutput& advance(double dt, double share = 1);
  /// Sets all currents to zero. The next `advance` continues with the field from before the stop.
  StopReport stop() noexcept;
  /// Lets an `advance` that another thread is in return early, so that `stop` can follow.
  void interrupt() noexcept { driver_.interrupt(); }

  /// Why the last `advance` ends a run, in words; empty if it does not. Three without an answer do.
  std::string trouble() const;

  const CoilOutput& output() const { return output_; }
  /// Target position of the field [µm].
  const Eigen::Vector3d& place() const { return place_; }
  const FieldGenerator& generator() const { return generator_; }
  /// Actuation at the target position.
  const Actuation& actuation() const { return actuation_; }

 private:
  bool turns_on_device() const;
  void mind_probes();
  Eigen::VectorXd make(const Eigen::Vector3d& field);
  Eigen::VectorXd wanted_currents(double dt);
  void send_currents(double dt, double share);
  void send_waveform(double dt, double share);

  const CoilSystem& system_;
  CoilDriver& driver_;
  FieldGenerator generator_;
  Setpoint setpoint_;
  Amplifiers amplifiers_;
  Eigen::Vector3d place_;
  Actuation actuation_;
  std::vector<double> channels_;
  CoilOutput output_;
  int misses_ = 0;        // consecutive outputs without an answer
  bool at_zero_ = false;  // confirmed after the last output
};

}  // namespace microswarm::actuation
