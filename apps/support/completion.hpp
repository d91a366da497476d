// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "support/command.hpp"

namespace microswarm::cli {

/// Completions of the last word typed after the program's name, as lines: first `words`, `files` or
/// `folders`, then the matching words, each with a tab and its description.
std::string completion(const CLI::App& app, const Suggestions& suggestions,
                       const std::vector<std::string>& typed);

}  // namespace microswarm::cli
