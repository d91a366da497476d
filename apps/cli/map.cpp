// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli.hpp"

namespace microswarm::cli {
void add_map(CLI::App& app, Action& action) { (void)app, (void)action; }
}  // namespace microswarm::cli
