// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "lab/sessions/host.hpp"

namespace microswarm::lab {

/// Creates a host, which opens the session in its thread.
std::unique_ptr<Host> make_host(Opening opening, Host::Callbacks callbacks);

}  // namespace microswarm::lab
