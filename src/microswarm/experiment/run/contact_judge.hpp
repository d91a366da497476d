// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "microswarm/experiment/run/run.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// How a contact is judged; see docs/explanation/safety.md.
struct JudgeParams {
  double lookback = 3;
  double aftermath = 2;
  int directions = 36;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.lookback,
          {"lookback", Unit::s, {0, 60}, "Time before a contact in which decisions are judged."});
    visit(self.aftermath,
          {"aftermath", Unit::s, {0, 60}, "Time after the contact that must stay free."});
    visit(self.directions,
          {"directions", Unit::none, {1, 3600}, "Number of escape headings, evenly spaced."});
  }
};

/// Hears a run and keeps what a judge asks for: every command, and the contacts.
class ContactLog : public RunListener {
 public:
  void on_tick(const Tick& tick) override;

  const std::vector<Command>& commands() const { return commands_; }  ///< one a tick
  const std::vector<RunEvent>& contacts() const { return contacts_; }

 private:
  std::vector<Command> commands_;
  std::vector<RunEvent> contacts_;
};

/// What could have been done about one contact.
struct ContactVerdict {
  RunEvent contact;
  bool avoidable = false;
  double decided = 0;    ///< when at the latest, at a tick [s]; of an avoidable one
  std::string_view way;  ///< "hold", "retreat", "hold, retreat" or "retreat, hold"; else empty
};

/// Judges every contact of a run of KinematicPlant. A contact at t_c was avoidable when from the
/// swarm's true state at some tick t between t_c − lookback and t_c − (response lag + observation
/// delay), touching nothing yet and the obstacle in sight, holding or retreating keeps it free of
/// any contact with walls and obstacles, as they truly moved, until t_c + aftermath. Commands
/// already given take effect before; the drift is that of the run. `scenario`, `world` and `trial`
/// are those of the run.
std::vector<ContactVerdict> judge_contacts(const Scenario& scenario, const World& world,
                                           std::uint32_t trial, const ContactLog& log,
                                           const JudgeParams& params = {});

}  // namespace microswarm
