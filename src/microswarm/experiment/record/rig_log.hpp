// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/io/hdf5_image.hpp"

namespace microswarm::experiment {

/// Latency of a rig: time from the arrival of a picture in the program to the driver's
/// acknowledgement of the first currents that answer it.
struct RigLatency {
  double median = 0;
  double p99 = 0;
  double longest = 0;
  int pictures = 0;
  int late_currents = 0;
  int ticks = 0;
  int missed_deadlines = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.median, s("latency_median", "Median from camera to current."));
    visit(self.p99, s("latency_p99", "99th percentile from camera to current."));
    visit(self.longest, s("latency_longest", "Longest time from camera to current."));
    visit(self.pictures, plain("pictures", "Pictures that currents answered."));
    visit(self.late_currents, plain("late_currents", "Pictures answered more than a tick later."));
    visit(self.ticks, plain("ticks", "Number of ticks."));
    visit(self.missed_deadlines, plain("missed_deadlines", "Ticks whose command came too late."));
  }
};

/// State of a rig's pictures at a time, relative to the start; NaN where it is not known.
struct PictureRow {
  double t = 0;             ///< [s]
  double light = 1;         ///< mean grey value
  double focus = 1;         ///< sharpness of walls or details
  double shift_px = 0;      ///< displacement of the map at its worst corner
  double unseen_share = 0;  ///< of the pictures of the last seconds
  double follow_share = 0;  ///< distance moved over that commanded
};

/// Part of a record that describes the rig: circumstances of the run, currents, and detections of
/// the camera. Times are those of the record's frames [s]. It is not part of the record's hash.
struct RigLog {
  std::string began{};                 ///< date and local time, ISO 8601
  std::string note{};                  ///< of the operator
  std::string rig_file{};              ///< all parameters of the rig as YAML, its scale included
  std::string coils_file{};            ///< text of the coil system's file, with the calibration
  std::string commissioning{};         ///< the rig's commissioning record, YAML; may be empty
  std::vector<std::string> coils{};    ///< names
  std::vector<double> turning_at{};    ///< times of changes of the field's frequency [s]
  std::vector<double> turning{};       ///< frequencies from these times on [Hz]
  std::vector<double> driven_at{};     ///< times of the outputs [s]
  std::vector<double> answered_at{};   ///< times of the driver's acknowledgements [s]
  std::vector<double> pictured_at{};   ///< arrival of the pictures that they answer [s]
  std::vector<double> currents{};      ///< acknowledged currents of all coils, output by output [A]
  std::vector<double> seen_at{};       ///< times of the pictures, one entry a body [s]
  std::vector<std::int64_t> bodies{};  ///< -1 for the swarm, otherwise an obstacle's number
  std::vector<Vec2> positions{};       ///< centres of the bodies [µm]
  std::vector<double> radii{};         ///< of circles around the bodies [µm]
  std::vector<PictureRow> pictures{};  ///< state of the pictures, about once a second
  std::optional<double> currents_until{};  ///< outputs after it are too many to be kept [s]
  std::optional<double> seen_until{};      ///< sightings after it are too many to be kept [s]
  std::optional<RigLatency> latency{};     ///< of the whole run, set at its end

  bool empty() const { return began.empty(); }
  void see(double t, std::int64_t body, Vec2 position, double radius);
};

/// Writes the group /rig, nothing for an empty log.
void write_rig_log(io::Hdf5Writer& out, const RigLog& log);

/// Reads the log; empty if there is none. Throws InputError if the columns do not fit together.
RigLog read_rig_log(const io::Hdf5Reader& in);

}  // namespace microswarm::experiment
