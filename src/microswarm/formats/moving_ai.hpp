// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/formats/images/mask.hpp"

namespace microswarm::formats {

/// Reads a grid map of the MovingAI benchmarks (Sturtevant, "Benchmarks for grid-based
/// pathfinding", 2012): `type octile` or `tile`, height, width, then one letter per cell. '.', 'G'
/// and 'S' are free, every other letter is blocked. The mask's set cells are the blocked ones.
/// `unknown` receives the letters that the format does not have, each once. Throws InputError
/// "NAME:LINE: WHY".
Mask read_moving_ai(const std::filesystem::path& path, std::string* unknown = nullptr);
Mask parse_moving_ai(std::string_view text, std::string_view name, std::string* unknown = nullptr);

/// MovingAI text of a mask: '@' where it is set, '.' elsewhere.
std::string moving_ai_text(const Mask& blocked);

/// A cell of a grid map, counted from the top left.
struct GridCell {
  int column = 0;
  int row = 0;
  friend bool operator==(GridCell, GridCell) = default;
};

/// Query of a .scen file: from cell to cell in octile moves without corner cutting.
struct GridQuery {
  std::string map{};  ///< file name as written in the .scen file
  int width = 0;      ///< size of the map [cells]
  int height = 0;
  GridCell start{};
  GridCell goal{};
  double optimal_length = 0;  ///< [cells]; a diagonal move counts √2
};

/// Reads a .scen file of the MovingAI benchmarks, version 1. Throws InputError "NAME:LINE: WHY",
/// also for a cell outside the map's size.
std::vector<GridQuery> read_scenarios(const std::filesystem::path& path);
std::vector<GridQuery> parse_scenarios(std::string_view text, std::string_view name);

}  // namespace microswarm::formats
