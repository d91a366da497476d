// SPDX-License-Identifier: Apache-2.0
// A rig with Helmholtz coils at a device of the test's own, and a scenario for it.
#pragma once

#include "program.hpp"
#include "tests/actuation/fake_device.hpp"

namespace microswarm::test {

class DrivenRig : public CommandLine {
 protected:
  DrivenRig() {
    write_coils("max_current_a: 10, max_voltage_v: 24, max_temperature_degc: 90");
    write("flight.yaml",
          "map: {type: polygons, lo_um: [0, 0], hi_um: [2000, 1000]}\n"
          "start: {x_um: 400, y_um: 500}\ngoal_um: [1500, 500]\ntime_limit_s: 60\n"
          "swarm: {type: vortex}\nnavigator: {type: radar}\n");
  }
  void write_coils(const std::string& limits) const {
    write("coils.yaml",
          "name: bench coils\ncoils: {type: helmholtz}\ndrives:\n  - {resistance_ohm: 0.9, "
          "inductance_mh: 2.5, thermal_resistance_k_per_w: 2.5, thermal_time_s: 400, " +
              limits + "}\n");
  }
  void write_rig(const FakeDevice& device) const {
    write("rig.yaml",
          "name: bench\ncoils: coils.yaml\n"
          "field: {kind: rotating, amplitude_mt: 8, frequency_hz: 10, max_pitch_deg: 7.5}\n"
          "drive_rate_hz: 100\n"
          "driver: {type: serial, boot_time_s: 0, reply_timeout_s: 0.1, full_scale_a: 10, port: " +
              device.port() +
              "}\n"
              "camera: {type: simulated, microscope: {um_per_px: 6}}\n"
              "safety: {lost_swarm_s: 3, max_frame_age_s: 3, deadman_s: 3, missed_deadlines: 100, "
              "max_pause_s: 3}\n");
  }
  /// `rig run` without an operator at a terminal.
  static Arguments arguments(const Arguments& more = {}) {
    Arguments all{"rig",      "run",          "flight.yaml",   "--rig",
                  "rig.yaml", "--other-stop", "--drawn-swarm", "--coils-cold"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// Lets it drive for `ms`. It arms once for its check of the driver, and again for the run;
  /// `armed`: how often earlier runs did.
  static void let_drive(FakeDevice& device, int ms, int armed = 0) {
    for (int i = 0; i < 2000 && device.count(actuation::CoilMessage::arm) < armed + 2; ++i)
      sleep_ms(10);
    sleep_ms(ms);
  }
};

}  // namespace microswarm::test
