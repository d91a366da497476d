// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/navigation/safe_interval/obstacle_forecast.hpp"
#include "microswarm/navigation/safe_interval/safe_interval_tuning.hpp"
#include "microswarm/navigation/steering/swarm_response.hpp"
#include "microswarm/planning/space_time/turn_first.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"

namespace microswarm::navigation {

/// Exact check of the next seconds. A command is safe if the swarm keeps its gaps for the
/// commitment and an escape remains after it: to continue, to hold, or another direction. The
/// escape of the last safe command is kept. Gaps are measured along the whole motion, relative to
/// the predicted motion of the bodies, and walls exactly. It is safe against turns if it does not
/// meet a slower body that turns round just after the frame, until this is seen through the noise
/// of its position and answered. Does not allocate once it has seen as many bodies.
class ImminentCheck {
 public:
  /// `speed` [µm/s] of the swarm, `tick` [s] between two commands.
  ImminentCheck(const ImminentTuning& tuning, const SwarmLimits& swarm, double speed, double tick);

  /// Situation of a step: all checks until the next call are from here.
  struct Situation {
    const Map* map = nullptr;
    const ObstacleForecast* forecast = nullptr;
    Pose2 pose{};
    double radius = 0;          ///< [µm]
    double wall_clearance = 0;  ///< [µm]
    Disc goal{};                ///< where the swarm stops
    SwarmResponse response{};   ///< to the commands
    double time = 0;            ///< at which the command takes effect [s]
  };
  void begin(const Situation& situation);

  /// Turns that a safe command must survive.
  enum class Turns { none, of_any_body };
  bool is_safe(const Command& command, Turns turns = Turns::none);
  /// The safe command with the smallest sum of turns from `wanted` and from `last`; nothing if
  /// there is none.
  std::optional<Command> nearest_safe(const Command& wanted, const Command& last,
                                      Turns turns = Turns::none);
  /// The command that continues the manoeuvre with which the last command was safe, if it still is.
  std::optional<Command> kept_escape();
  /// Start of the manoeuvre of two legs that is free of contact for longest, then keeps the largest
  /// gap; one that continues `last` is kept unless another is clearly better.
  Command best_escape(const Command& last);

 private:
  /// Course of a leg.
  struct Outcome {
    int until = 0;     ///< first sample without the gap
    double least = 0;  ///< least gap, at most counted_gap [µm]
    Pose2 end{};
    std::optional<int> stood{};  ///< sample at which it stopped before a wall
  };
  /// A body that may come near.
  struct Near {
    std::size_t index = 0;
    double noise_gap = 0;  ///< [µm]
    double present = 0;    ///< gap now [µm]
    int turned = 0;        ///< samples for which it is not met if it turns round
  };
  /// Index of a body in near_ that has turned round.
  using Turned = std::optional<std::size_t>;
  struct Choice {
    double cost = 0;
    Command command{};
  };

  /// A command. Where it turns first, its speed is low until then.
  struct Leg {
    Command command{};
    bool turns_first = false;
  };
  /// A leg, and another after some time.
  struct Manoeuvre {
    Leg first{};
    double switch_time = 0;  ///< from now [s]
    Leg second{};
    double checked = 0;  ///< time that must be free for it to be continued [s]
  };

  Outcome roll(Pose2 from, const Leg& leg, int first, int last, bool in_contact_only,
               Turned turned = {}) const;
  Outcome roll(const Manoeuvre& manoeuvre, bool in_contact_only) const;
  std::optional<Leg> escape_after(const Pose2& from, const Command& command, int first);
  Leg escape(int k) const;
  Command begin_of(const Manoeuvre& manoeuvre) const;
  double time_of(int sample) const;
  int samples_until(double time) const;
  double slow_speed() const;
  bool turns_first(const Leg& leg, double given, const Pose2& pose) const;
  double required(const Near& near, int sample) const;
  Command direction(int k, int count, double share = 1) const;

  ImminentTuning tuning_;
  planning::TurnFirst turning_;
  double speed_;
  double tick_;
  double committed_time_;
  int escapes_;
  Situation now_;
  int samples_ = 0;                ///< of the horizon
  int commanded_ = 0;              ///< until the next command
  int committed_ = 0;              ///< of the commitment
  double present_hollow_gap_ = 0;  ///< [µm]
  std::vector<Near> near_;
  std::vector<Choice> choices_;
  int last_escape_ = 0;             ///< the one that was free last time
  double time_ = 0;                 ///< of the situation [s]
  std::optional<Manoeuvre> found_;  ///< that begins with the last command that was safe, or best
  std::optional<Manoeuvre> kept_;   ///< what is left of that of the last step
};

}  // namespace microswarm::navigation
