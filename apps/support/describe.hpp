// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "support/command.hpp"

namespace microswarm::cli {

/// The commands below one that are not hidden.
std::vector<const CLI::App*> listed_commands(const CLI::App& app);

/// Returns whether the option takes a value; a flag does not.
bool takes_value(const CLI::Option& option);
/// Returns whether the option may be given several times.
bool is_repeatable(const CLI::Option& option);

/// Meaning of an option, as in the help: its doc, repetition and default.
std::string meaning(const CLI::Option& option, const Facts& facts);

/// Begins the last part of a command's help.
inline constexpr const char* example_head = "Example:\n";

/// A command and those below it: name, doc, former_names, arguments, options, example, commands. Of
/// an option: names, value (as in the help; empty for a flag), words, default (also "required",
/// "none", and of a flag "off"), required, repeatable, needs, excludes, group, doc.
nlohmann::ordered_json describe(const CLI::App& app, const Facts& facts);

}  // namespace microswarm::cli
