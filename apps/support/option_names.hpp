// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace microswarm::cli {

/// Sets the options of the command that runs, "--out" each, for `with_options`. Called before its
/// action, by one thread.
void set_options(std::vector<std::string> options);

/// A message of the library with the options of the command that runs: "give um_per_unit" becomes
/// "give um_per_unit (--um-per-unit)". The library knows no options, since other interfaces show
/// its messages, too. A message that names the option stays as it is.
std::string with_options(std::string message);

}  // namespace microswarm::cli
