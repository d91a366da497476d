// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "support/cli.hpp"

namespace microswarm::cli {

/// A scenario and its rig.
struct RigPair {
  std::string scenario;
  std::string rig;
  std::vector<std::string> settings{};  ///< settings of the scenario
  std::vector<std::string> rig_settings{};
};

/// Runs every pair with every error of rig_errors(), prints a table of arrivals and
/// messages, and writes errors.csv to the folder, if one is named. Returns an exit code:
/// not_reached if a run ended as arrived while the swarm was elsewhere.
int simulate_errors(const std::vector<RigPair>& pairs, int trials, int jobs, const std::string& out,
                    const Context& context);

}  // namespace microswarm::cli
