// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace microswarm {

/// Name of an input that a message asks for, such as "um_per_px", for the user of this program: the
/// key itself, unless the program has other names, as a command line has options.
std::string input_name(std::string_view key);

/// Sets how input_name names a key; an empty answer leaves the key. Called by a program when it
/// starts, by one thread.
void name_inputs(std::function<std::string(std::string_view key)> name);

}  // namespace microswarm
