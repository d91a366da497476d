// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace microswarm::cli {

/// Error message of a command line, in one line that refers to the help.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace microswarm::cli
