// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/rig/params/rig_experiment.hpp"

namespace microswarm::rig {

/// Size and times of an identification.
struct IdentifyPlan {
  double speed = 0;      ///< commanded [µm/s]
  double frequency = 0;  ///< usual one of the field, of a rolling field its maximum [Hz]
  double leg = 0;        ///< duration of a side of the square [s]
  double dwell = 0;      ///< duration of each direction at a frequency of the sweep [s]
  std::vector<double> frequencies{};  ///< of the sweep, rising [Hz]; empty: no sweep
  double length_per_turn = 0;         ///< of a rolling field [µm]; 0: another kind
  double max_frequency = 0;           ///< of the sweep [Hz]
  double reach = 0;  ///< distance from the middle at which the swarm turns back [µm]
  double room = 0;   ///< radius of the free disc that is needed [µm]

  double side() const { return speed * leg; }  ///< of the square [µm]
  /// Expected duration [s].
  double seconds() const;
};

/// Room and times for an identification.
struct IdentifyRoom {
  double free = 0;    ///< distance from the swarm to walls and the picture's edge [µm]
  double radius = 0;  ///< of the swarm [µm]
  double speed = 0;   ///< usual command [µm/s]
  double seconds = 60;
  std::optional<double> max_frequency{};  ///< of the sweep [Hz]; none: as the rig allows
};

/// Largest frequency at which the rig makes its field: three times the usual one, less if drive
/// rate or coils do not allow it, at least the usual one [Hz].
double largest_frequency(const Rig& rig);

/// The experiment without obstacles and end, with a field that may turn up to `max_frequency` [Hz].
RigExperiment for_identification(RigExperiment on, double max_frequency);

/// Plans a square in both senses and a sweep of the frequency from half the usual one. The square
/// is made smaller until it fits. Throws InputError if there is no room, with the room that is
/// needed, or if a given maximum frequency is not possible.
IdentifyPlan plan_identification(const Rig& rig, const IdentifyRoom& room);

/// One step of an identification.
struct IdentifyStep {
  Command command{};
  double frequency = 0;  ///< of the field [Hz]
  bool is_sweep = false;
};

/// Commands of an identification, given what is seen. The swarm is kept within the plan's reach of
/// its place at the start and is brought back between sections. The sweep ends with the first
/// frequency at which the swarm falls behind.
class IdentifyProgramme {
 public:
  explicit IdentifyProgramme(IdentifyPlan plan) : plan_(std::move(plan)) {}

  /// The step at time `t` [s] with the swarm where it is seen; nothing at the end. Without a swarm
  /// it holds.
  std::optional<IdentifyStep> next(double t, const std::optional<Vec2>& seen);
  const IdentifyPlan& plan() const { return plan_; }
  /// Elapsed share of the expected duration.
  double progress() const;

 private:
  enum class Part { square, back, sweep, rest };

  IdentifyStep hold() const;
  std::optional<IdentifyStep> drive(double t, Vec2 seen);
  IdentifyStep go_back(double t, Vec2 seen);
  IdentifyStep sweep(double t, Vec2 seen);
  IdentifyStep sweep_step() const;
  void end_direction(double t, Vec2 seen);
  bool falls_behind() const;
  void begin(Part part, double t);
  bool is_far(Vec2 seen) const;
  IdentifyStep drive_square(double t, Vec2 seen);

  IdentifyPlan plan_;
  Part part_ = Part::square;
  Part after_ = Part::square;  // the part after going back
  bool started_ = false;
  Vec2 middle_{};
  double began_ = 0;  // of the identification [s]
  double now_ = 0;
  double since_ = 0;                   // of the leg or the way back [s]
  int leg_ = 0;                        // of the square
  std::size_t level_ = 0;              // of the sweep
  int direction_ = 0;                  // of the sweep: 0, 1 and 2, 3 are those of a level
  std::optional<double> measured_at_;  // time at which the speed of a leg counts from [s]
  Vec2 measured_from_{};
  double moved_ = 0;      // [µm] in what was measured of a level
  double commanded_ = 0;  // [µm] meanwhile
  double best_ = 0;       // largest share of the commanded distance of a level
};

}  // namespace microswarm::rig
