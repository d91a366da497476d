// SPDX-License-Identifier: Apache-2.0
#include "support/option_names.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

namespace microswarm::cli {
namespace {

/// Words of the library, and the option that does what they ask for.
struct NamedOption {
  std::string_view words;
  std::string_view option;
};
constexpr NamedOption named_options[] = {
    {"give um_per_px", "--map-um-per-px"},  // before --um-per-px, which then is of a photograph
    {"give um_per_px", "--um-per-px"},         {"give um_per_unit", "--um-per-unit"},
    {"the times of the pictures", "--times"},  {"the size of a cell is missing", "--cell"},
    {"give another database", "--out"},        {"a tree to keep", "--save-tree"},
    {"give it as the rig", "--rig"},           {"start with cold coils", "--coils-cold"},
    {"run without limits", "--without-limits"}};

/// Words of the library, and what they mean at the command line.
struct NamedCommand {
  std::string_view words;
  std::string_view command;
};
constexpr NamedCommand named_commands[] = {
    {"export its trials as a table",
     "`microswarm export` writes its trials as a table, with --csv FILE"},
    {"read it with read_record", "`microswarm report` and `microswarm replay` take it"}};

std::vector<std::string>& options_in_use() {
  static std::vector<std::string> options;
  return options;
}

}  // namespace

void set_options(std::vector<std::string> options) { options_in_use() = std::move(options); }

std::string with_options(std::string message) {
  std::string_view last;
  for (const auto& [words, option] : named_options) {
    const std::size_t at = message.find(words);
    if (at == message.npos || words == last || message.find(option) != message.npos ||
        !std::ranges::count(options_in_use(), option))
      continue;
    message.insert(at + words.size(), " (" + std::string(option) + ")");
    last = words;
  }
  for (const auto& [words, command] : named_commands)
    if (const std::size_t at = message.find(words); at != message.npos)
      message.replace(at, words.size(), command);
  return message;
}

}  // namespace microswarm::cli
