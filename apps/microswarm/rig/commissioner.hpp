// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "microswarm/rig/commissioning/commissioning.hpp"
#include "support/command.hpp"

namespace microswarm::cli {

/// Adds --by NAME, the person in the commissioning record.
void add_by(Command cmd, std::string& by);

/// The given name, or the user's.
std::string commissioner(const std::string& by);

/// Adds entries to the commissioning record of a rig's file and prints on stderr what was added.
void commission(const std::filesystem::path& rig_file,
                const std::vector<rig::CommissioningEntry>& entries);

/// The state of a record for --json.
nlohmann::ordered_json commissioning_json(const rig::CommissioningState& state);

}  // namespace microswarm::cli
