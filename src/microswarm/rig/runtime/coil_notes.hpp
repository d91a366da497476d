// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "microswarm/actuation/coils/coil_controller.hpp"

namespace microswarm::rig {

/// Notes about broken probes and coils beyond their limit, each once a run: a loose wire would say
/// so at each output.
class CoilNotes {
 public:
  /// Returns what is new in an output, a line each. The model alone never exceeds a coil's limit.
  std::vector<std::string> take(const actuation::CoilOutput& output,
                                const actuation::CoilSystem& system);

 private:
  std::set<std::string> said_;  // troubles, and names of hot coils
};

}  // namespace microswarm::rig
