// SPDX-License-Identifier: Apache-2.0
#include "support/option_names.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "microswarm/core/errors/input_names.hpp"

namespace microswarm::cli {
namespace {

/// Keys that an option of another name sets; the first one that the command has.
constexpr std::pair<std::string_view, std::string_view> other_options[] = {
    {"um_per_px", "--map-um-per-px"},  // then --um-per-px is of a photograph
    {"database", "--out"}};
/// Commands in the place of functions of the library.
constexpr std::pair<std::string_view, std::string_view> commands_instead[] = {
    {"read_sweep", "`microswarm export`, with --csv FILE"},
    {"read_record", "`microswarm report` or `microswarm replay`"}};

std::string option_of(std::string_view key) {
  std::string option = "--" + std::string(key);
  std::ranges::replace(option, '_', '-');
  return option;
}

}  // namespace

void name_inputs_by_options(std::vector<std::string> options) {
  name_inputs([options = std::move(options)](std::string_view key) -> std::string {
    for (const auto& [function, command] : commands_instead)
      if (key == function) return std::string(command);
    for (const auto& [other, option] : other_options)
      if (key == other && std::ranges::count(options, option)) return std::string(option);
    const std::string option = option_of(key);
    return std::ranges::count(options, option) ? option : std::string();
  });
}

}  // namespace microswarm::cli
