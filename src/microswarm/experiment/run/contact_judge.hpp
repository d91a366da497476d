// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "microswarm/experiment/run/run_listener.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {

/// Settings of `judge_contacts`; see docs/explanation/safety.md.
struct JudgeParams {
  double lookback = 3;
  double aftermath = 2;
  int directions = 36;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.lookback,
          s("lookback", 0, 60, "Time before a contact in which decisions are judged."));
    visit(self.aftermath, s("aftermath", 0, 60, "Time after the contact that must stay free."));
    visit(self.directions,
          plain("directions", 1, 3600, "Number of escape headings, evenly spaced."));
  }
};

/// Records a run for a judge: every command, and the contacts.
class ContactLog : public RunListener {
 public:
  void on_tick(const Tick& tick) override;

  const std::vector<Command>& commands() const { return commands_; }  ///< one per tick
  const std::vector<RunEvent>& contacts() const { return contacts_; }

 private:
  std::vector<Command> commands_;
  std::vector<RunEvent> contacts_;
};

/// Verdict on one contact: whether it was avoidable, and by which manoeuvre.
struct ContactVerdict {
  RunEvent contact{};
  bool avoidable = false;
  double decided = 0;       ///< time of the last tick at which it was avoidable [s]
  std::string manoeuvre{};  ///< "hold", "retreat", "hold, retreat", "retreat, hold" or empty
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.contact, plain("contact", "The contact."));
    visit(self.avoidable, plain("avoidable", "Whether it could have been avoided."));
    visit(self.decided, s("decided", "Time of the last decision that avoids it."));
    visit(self.manoeuvre, plain("manoeuvre", "Manoeuvre that avoids it, or empty."));
  }
};

/// Judges every contact of a run of KinematicPlant. A contact at t_c was avoidable if, from the
/// true state of the swarm at some tick t between t_c − lookback and t_c − (response lag +
/// observation delay), a hold or retreat manoeuvre avoids all contacts with walls and obstacles
/// until t_c + aftermath. At t the swarm must be free of contact and the obstacle in view.
/// Obstacles follow their true motion, commands already given take effect first, and the drift is
/// that of the run. `scenario`, `world` and `trial` are those of the run.
std::vector<ContactVerdict> judge_contacts(const Scenario& scenario, const World& world,
                                           std::uint32_t trial, const ContactLog& log,
                                           const JudgeParams& params = {});

}  // namespace microswarm::experiment
