// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm::vision {

/// Natural order of names: runs of digits are compared as numbers, the rest letter by letter,
/// small and capital ones alike.
bool naturally_before(std::string_view a, std::string_view b);

/// Sorts files by the natural order of their names without extensions. A '-' before a number is a
/// sign where other names lack it and differ in nothing else; a point between numbers is decimal
/// where the digits behind it are not equally many.
void sort_naturally(std::vector<std::filesystem::path>& files);

/// Keeps, in natural order, the files of one series: one kind where several share a name, and one
/// channel (`_ch0`, `_c0`, `_w1`) and slice (`_z3`) where names have several at the same other
/// numbers. A few files of other words than all others are left out. Returns notes. Throws
/// InputError "FOLDER: WHY" if there are several channels and none is chosen, and if names have two
/// numbers that vary for themselves, as those of several cameras or positions.
std::vector<std::string> choose_pictures(std::vector<std::filesystem::path>& files,
                                         std::optional<int> stack_channel, std::optional<int> slice,
                                         const std::string& folder);

/// Numbers in the names of a series.
struct NumberedNames {
  /// For each file its number's distance from the first one's, in steps; a step is the usual
  /// distance of neighbours.
  std::vector<double> steps{};
  int gaps = 0;             ///< neighbours that are farther apart than a step
  std::string first_gap{};  ///< "f005.png and f026.png"
};

/// Whether names differ in several numbers, or in words and numbers: steps of time are not known.
bool differ_in_several(const std::vector<std::filesystem::path>& files);

/// Numbers of sorted files, whose names must be alike except for one number; nothing otherwise.
std::optional<NumberedNames> numbers_in(const std::vector<std::filesystem::path>& files);

}  // namespace microswarm::vision
