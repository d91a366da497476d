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
/// Commands in the place of a function of the library.
constexpr std::string_view instead_of_read_record = "`microswarm report` or `microswarm replay`";
/// Key of the map's scale, for commands whose --um-per-px is of a photograph.
constexpr std::string_view key_of_map_scale = "map.um_per_px";

std::string option_of(std::string_view key) {
  std::string option = "--" + std::string(key);
  std::ranges::replace(option, '_', '-');
  return option;
}

}  // namespace

void name_inputs_by_options(std::vector<std::string> options) {
  name_inputs([options = std::move(options)](std::string_view key) -> std::string {
    const auto has = [&](std::string_view option) {
      return std::ranges::count(options, option) > 0;
    };
    if (key == "read_record") return std::string(instead_of_read_record);
    for (const auto& [other, option] : other_options)
      if (key == other && has(option)) return std::string(option);
    if (key == "um_per_px" && has("--photo")) return std::string(key_of_map_scale);
    const std::string option = option_of(key);
    return has(option) ? option : std::string();
  });
}

}  // namespace microswarm::cli
