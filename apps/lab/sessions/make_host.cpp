// SPDX-License-Identifier: Apache-2.0
#include "lab/sessions/make_host.hpp"

#include "lab/sessions/rig_thread.hpp"
#include "lab/sessions/session_thread.hpp"
#include "microswarm/rig/session/open_on_rig.hpp"

namespace microswarm::lab {

std::unique_ptr<Host> make_host(Opening opening, Host::Callbacks callbacks) {
  if (opening.live) return std::make_unique<RigThread>(std::move(opening), std::move(callbacks));
  return std::make_unique<SessionThread>(
      std::move(opening), std::move(callbacks),
      [](const auto& file, const auto& options) { return rig::open_on_rig(file, options); });
}

}  // namespace microswarm::lab
