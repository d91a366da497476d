// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/io/hdf5_image.hpp"

namespace microswarm {

/// What a record keeps of a run on a rig beside the run itself: under which circumstances, what
/// went to the coils, and what the camera showed. Times are those of the record's frames [s]. No
/// part of it is in the record's hash.
struct RigLog {
  std::string began;                 ///< date and local time, ISO 8601
  std::string note;                  ///< of the operator
  std::string rig_file;              ///< all parameters of the rig, its scale included, as YAML
  std::string coils_file;            ///< text of the coil system's file: the calibration
  std::vector<std::string> coils;    ///< names
  std::vector<double> driven_at;     ///< times of the sendings [s]
  std::vector<double> currents;      ///< acknowledged: of all coils at the first sending, … [A]
  std::vector<double> seen_at;       ///< times of the pictures, one entry a body [s]
  std::vector<std::int64_t> bodies;  ///< -1 for the swarm, otherwise an obstacle's number
  std::vector<Vec2> places;          ///< of the bodies' centres [µm]
  std::vector<double> radii;         ///< of circles around the bodies [µm]

  bool empty() const { return began.empty(); }
  void see(double t, std::int64_t body, Vec2 place, double radius);
};

/// Writes the group /rig, nothing for an empty log.
void write_rig_log(Hdf5Writer& out, const RigLog& log);

/// Reads it; empty if there is none. Throws InputError if the columns do not fit together.
RigLog read_rig_log(const Hdf5Reader& in);

}  // namespace microswarm
