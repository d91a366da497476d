// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/reproduce/reproduce.hpp"

namespace microswarm::reproduce {

/// A figure of a paper, and what makes its rows.
struct Figure {
  std::string_view name;
  std::vector<ReproduceRow> (*make)(const ReproduceOptions& options, const Stop& stop);
};

/// Rows of the one that is asked for, or of all when empty; with a folder, as PAPER.csv too. What
/// there is of a figure that was stopped has no verdicts. Throws InputError for an unknown one.
std::vector<ReproduceRow> reproduce_figures(std::string_view paper, std::span<const Figure> figures,
                                            const std::string& figure,
                                            const ReproduceOptions& options, const Stop& stop);

/// A file of real input outside the repository, in the folder that the environment variable
/// MICROSWARM_DATA names; nothing, and a note that `what` is left out, where it is absent.
std::optional<std::filesystem::path> data_file(const ReproduceOptions& options,
                                               std::string_view name, std::string_view what);

}  // namespace microswarm::reproduce
