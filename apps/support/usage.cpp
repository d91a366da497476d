// SPDX-License-Identifier: Apache-2.0
#include "support/usage.hpp"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "microswarm/core/text/text.hpp"
#include "support/describe.hpp"

namespace microswarm::cli {
namespace {

using Names = std::vector<std::string>;

Names command_names(const CLI::App& app) {
  Names names;
  for (const CLI::App* command : listed_commands(app)) names.push_back(command->get_name());
  return names;
}

Names option_names(const CLI::App& app) {
  Names names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string nearest(const std::string& word, const Names& names) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  return std::string(nearest_word(word, views));
}

/// Message for an unexpected word on the command line.
std::string stray(const CLI::App& app, const std::string& word) {
  if (word.starts_with('-')) {
    const std::string name = word.substr(0, word.find('='));
    const std::string meant = nearest(name, option_names(app));
    return "unknown option " + quote(name) +
           (meant.empty() ? "" : ", did you mean '" + meant + "'?");
  }
  const Names commands = command_names(app);
  if (commands.empty()) return "unexpected argument " + quote(word);
  const std::string meant = nearest(word, commands);
  return "unknown command " + quote(word) +
         (meant.empty() ? fmt::format(", there are: {}", fmt::join(commands, ", "))
                        : ", did you mean '" + meant + "'?");
}

std::string what_is_wrong(const CLI::App& app, const CLI::ParseError& error) {
  const Names commands = command_names(app);
  if (!commands.empty() && app.get_subcommands().empty())
    return fmt::format("a command is missing, there are: {}", fmt::join(commands, ", "));
  return one_line(error.what());
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* at = &app;
  std::string path = app.get_name();
  for (;;) {  // descends to the innermost command given
    const Names left = at->remaining();
    const auto named = at->get_subcommands();
    if (!left.empty() || named.empty()) {
      const std::string what = left.empty() ? what_is_wrong(*at, error) : stray(*at, left.front());
      return fmt::format("{} (see {} --help)", what, path);
    }
    at = named.back();
    path += " " + at->get_name();
  }
}

}  // namespace microswarm::cli
