// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "support/command.hpp"

namespace microswarm::cli {

/// Lines a shell offers for the last of the words typed after the program's name: first
/// `words`, `files` or `folders`, then the words that fit, each with a tab and its description.
std::string completion(const CLI::App& app, const Facts& facts,
                       const std::vector<std::string>& typed);

}  // namespace microswarm::cli
