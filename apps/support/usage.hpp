// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace microswarm::cli {

/// What is wrong with a command line, in one line that says where help is.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace microswarm::cli
