// SPDX-License-Identifier: Apache-2.0
#include "rig/real_coils.hpp"

#include <unistd.h>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"
#include "rig/keys/key_terminal.hpp"

namespace microswarm::cli {

void add_coil_options(Command cmd, CoilOptions& o) {
  cmd.add_flag("--without-limits", o.without_limits,
               "Drive coils whose file limits no current or temperature");
  cmd.add_flag("--coils-cold", o.coils_cold, "The coils are at ambient temperature");
  cmd.add_flag("--other-stop", o.other_stop, "Run without a terminal and its emergency key");
}

void require_emergency_stop(const CoilOptions& o) {
  if (!has_keys() && !o.other_stop)
    throw InputError(
        "no terminal, so no emergency key: with an emergency stop of another kind, run with "
        "--other-stop (Ctrl-C and SIGTERM set the coils to zero, too)");
}

void require_person(const rig::Rig& rig, const CoilOptions& o, bool dry, bool drawn_swarm) {
  if (dry || !rig::has_coil_device(rig)) return;
  require_emergency_stop(o);
  if (rig::shows_drawn_swarm(rig.params) && !drawn_swarm)
    throw rig.keys.error("camera",
                         "the camera is simulated and the coil driver is not: real coils would be "
                         "driven for a drawn swarm; for a test, run with --drawn-swarm");
}

void note_how_to_stop(bool has_keys, const char* keys) {
  if (has_keys)
    note("space, e or Esc: coils to zero at once{}\n", keys);
  else
    note("to stop: `kill -INT {}`, or the emergency stop of the device\n", ::getpid());
}

Bench::Bench(const rig::Rig& of, const CoilOptions& o) : rig(of) {
  const bool real = rig::has_coil_device(rig);
  if (real) require_emergency_stop(o);
  if (real && !o.without_limits) rig.keys.require_none(rig::missing_limits(rig));
  driver = rig::open_coils(rig);
  if (real) kept.emplace(rig, o.coils_cold);
  temperatures =
      kept ? kept->at_start() : actuation::Amplifiers(rig.system.amplifiers()).temperatures();
  if (kept && !kept->known()) note_each({kept->why_hot()});
}

bool note_zero(const actuation::StopReport& zero) {
  if (!zero.confirmed)
    note(
        "microswarm: the coil driver did not confirm that the coils are at zero; its own watchdog "
        "must do it\n");
  else if (!zero.good())
    note("microswarm: the coil driver {}\n", zero.trouble);
  return zero.good();
}

}  // namespace microswarm::cli
