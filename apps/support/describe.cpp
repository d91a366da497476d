// SPDX-License-Identifier: Apache-2.0
#include "support/describe.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> to_names(const CLI::Option& option) {
  std::vector<std::string> names;
  if (option.get_positional()) return {option.get_name(true)};
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> to_names(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  names.reserve(options.size());
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);
  return names;
}

std::string shown_default(const CLI::Option& option, const OptionFacts& facts) {
  if (option.get_required()) return "required";
  if (!takes_value(option)) return "off";
  return facts.default_text.empty() ? "none" : facts.default_text;
}

/// The name of an option's value, without the words behind it.
std::string value_name(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  return takes_value(option) ? name.substr(0, name.find(":{")) : "";
}

Json to_json(const CLI::Option& option, const OptionFacts& facts) {
  return {{"names", to_names(option)},
          {"value", value_name(option)},
          {"words", facts.words},
          {"default", shown_default(option, facts)},
          {"required", option.get_required()},
          {"repeatable", is_repeatable(option)},
          {"needs", to_names(option.get_needs())},
          {"excludes", to_names(option.get_excludes())},
          {"group", option.get_group()},
          {"doc", option.get_description()}};
}

}  // namespace

std::vector<const CLI::App*> listed_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

bool is_repeatable(const CLI::Option& option) {
  return option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
}

std::string meaning(const CLI::Option& option, const Facts& facts) {
  const auto found = facts.find(&option);
  const std::string value = found == facts.end() ? "" : found->second.default_text;
  return option.get_description() + (is_repeatable(option) ? " (repeatable)" : "") +
         (value.empty() || option.get_required() ? "" : " (default: " + value + ")");
}

Json describe(const CLI::App& app, const Facts& facts) {
  Json arguments = Json::array(), options = Json::array(), commands = Json::array();
  for (const CLI::Option* option : app.get_options()) {
    const auto found = facts.find(option);
    const Json json = to_json(*option, found == facts.end() ? OptionFacts{} : found->second);
    (option->get_positional() ? arguments : options).push_back(json);
  }
  for (const CLI::App* command : listed_commands(app))
    commands.push_back(describe(*command, facts));
  std::string footer = app.get_footer();
  const bool has_example = footer.starts_with(example_head);
  if (has_example) footer.erase(0, std::string_view(example_head).size());
  return {{"name", app.get_name()},
          {"doc", app.get_description()},
          {"former_names", app.get_aliases()},
          {"arguments", arguments},
          {"options", options},
          {has_example ? "example" : "footer", footer},
          {"commands", commands}};
}

}  // namespace microswarm::cli
