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

/// A figure of a paper and the function that computes its rows.
struct Figure {
  std::string_view name{};
  std::vector<report::ReproduceRow> (*make)(const ReproduceOptions& options, const Stop& stop);
};

/// Rows of one figure, or of all if `figure` is empty; with an output folder, also written as
/// PAPER.csv. An interrupted figure gives partial rows without verdicts. Throws InputError for an
/// unknown figure.
std::vector<report::ReproduceRow> reproduce_figures(std::string_view paper,
                                                    std::span<const Figure> figures,
                                                    const std::string& figure,
                                                    const ReproduceOptions& options,
                                                    const Stop& stop);

/// Path of a real input file in the folder named by the environment variable MICROSWARM_DATA. If
/// the file is missing, the result is empty and a note says that `what` is omitted.
std::optional<std::filesystem::path> data_file(const ReproduceOptions& options,
                                               std::string_view name, std::string_view what);

}  // namespace microswarm::reproduce
