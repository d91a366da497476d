// SPDX-License-Identifier: Apache-2.0
#include "rig/real_coils.hpp"

#include <poll.h>
#include <unistd.h>

#include <utility>

#include "microswarm/actuation/drivers/coil_drive.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"

namespace microswarm::cli {

EmergencyKey::EmergencyKey(std::function<void()> stop, const Stop& ended)
    : stop_(std::move(stop)), ended_(ended) {
  if (::isatty(STDIN_FILENO) == 0 || ::tcgetpgrp(STDIN_FILENO) != ::getpgrp()) return;
  if (::tcgetattr(STDIN_FILENO, &before_) != 0) return;
  thread_ = std::thread([this] { listen(); });
}

EmergencyKey::~EmergencyKey() {
  over_ = true;
  if (thread_.joinable()) thread_.join();
}

void EmergencyKey::listen() {
  termios keys = before_;
  keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  while (!over_ && !ended_.requested()) {
    // Repeated, because a shell resets the terminal when the program is suspended and resumed.
    if (::tcgetpgrp(STDIN_FILENO) == ::getpgrp()) ::tcsetattr(STDIN_FILENO, TCSANOW, &keys);
    pollfd in{STDIN_FILENO, POLLIN, 0};
    if (::poll(&in, 1, 20) <= 0) continue;
    char key = 0;
    if (::read(STDIN_FILENO, &key, 1) != 1) break;
    if (key == ' ' || key == 'e' || key == 'E' || key == '\x1b') stop_();
  }
  if (::tcgetpgrp(STDIN_FILENO) == ::getpgrp()) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

void add_coil_options(Command cmd, CoilOptions& o) {
  cmd.add_flag("--without-limits", o.without_limits,
               "Drive coils whose file limits no current or temperature");
  cmd.add_flag("--coils-cold", o.coils_cold, "The coils are at ambient temperature");
  cmd.add_flag("--other-stop", o.other_stop, "Run without a terminal and its emergency key");
}

void require_emergency_stop(const CoilOptions& o) {
  if (::isatty(STDIN_FILENO) == 0 && !o.other_stop)
    throw InputError(
        "no terminal, so no emergency key: with an emergency stop of another kind, run with "
        "--other-stop (Ctrl-C and SIGTERM set the coils to zero, too)");
}

Bench::Bench(const Rig& of, const CoilOptions& o) : rig(of) {
  const bool real = has_coil_device(rig);
  if (real) require_emergency_stop(o);
  if (real && !o.without_limits) rig.keys.require_none(missing_limits(rig));
  driver = open_coils(rig);
  if (real) kept.emplace(rig, o.coils_cold);
  temperatures = kept ? kept->at_start() : CoilDrive(rig.system.drives()).temperatures();
  if (kept && !kept->known()) note("note: {}\n", kept->why_hot());
}

bool note_zero(bool confirmed) {
  if (!confirmed)
    note(
        "microswarm: the coil driver did not confirm that the coils are at zero; its own watchdog "
        "must do it\n");
  return confirmed;
}

}  // namespace microswarm::cli
