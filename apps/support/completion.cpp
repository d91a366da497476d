// SPDX-License-Identifier: Apache-2.0
#include "support/completion.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "support/describe.hpp"

namespace microswarm::cli {
namespace {

using CLI::App;

/// Words to choose from, or the kind of file wanted.
struct Offer {
  std::string kind = "words";
  std::vector<Suggestion> words{};
};

/// Position in the command tree after the words before the last one.
struct Place {
  const App* at;
  const CLI::Option* wants = nullptr;  ///< option whose value is next
  std::size_t arguments = 0;           ///< number of arguments given
  std::set<const CLI::Option*> given{};

  void pass(const std::string& word) {
    if (wants) {
      wants = nullptr;
    } else if (word.starts_with('-')) {
      const CLI::Option* option = at->get_option_no_throw(word.substr(0, word.find('=')));
      if (!option) return;
      given.insert(option);
      if (takes_value(*option) && word.find('=') == std::string::npos) wants = option;
    } else if (const App* command = find_command(word)) {
      *this = {.at = command};
    } else {
      ++arguments;
    }
  }

  const App* find_command(const std::string& word) const {
    const auto found = at->get_subcommands([&](const App* c) { return c->check_name(word); });
    return found.empty() ? nullptr : found.front();
  }

  /// The next argument, if any.
  const CLI::Option* argument() const {
    const auto all = at->get_options([](const CLI::Option* o) { return o->get_positional(); });
    if (arguments < all.size()) return all[arguments];
    if (all.empty() || all.back()->get_items_expected_max() <= 1) return nullptr;
    return all.back();
  }
};

Offer offered_values(const CLI::Option& option, const Facts& facts, const std::string& typed) {
  const auto found = facts.find(&option);
  if (found != facts.end() && found->second.suggest) return {.words = found->second.suggest(typed)};
  if (found != facts.end() && !found->second.words.empty())
    return {.words = suggest_words(found->second.words)(typed)};
  const std::string type = option.get_type_name();
  if (type == "FOLDER") return {.kind = "folders"};
  if (type == "FILE" || type == "VIDEO" || type == "CSV") return {.kind = "files"};
  return {};
}

Offer offered_commands(const App& app) {
  Offer offer;
  for (const App* command : listed_commands(app))
    offer.words.push_back({command->get_name(), command->get_description()});
  return offer;
}

Offer offered_options(const Place& place, const Facts& facts) {
  Offer offer;
  for (const CLI::Option* option : place.at->get_options()) {
    if (option->get_lnames().empty() || (place.given.contains(option) && !is_repeatable(*option)))
      continue;
    offer.words.push_back({"--" + option->get_lnames().front(), meaning(*option, facts)});
  }
  return offer;
}

/// Prefixes the values with "--option=".
Offer joined(Offer values, const std::string& before) {
  for (Suggestion& word : values.words) word.word.insert(0, before);
  return values;
}

Offer offer_for(const Place& place, const std::string& word, const Facts& facts) {
  if (place.wants) return offered_values(*place.wants, facts, word);
  if (word.starts_with('-')) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) return offered_options(place, facts);
    const CLI::Option* option = place.at->get_option_no_throw(word.substr(0, equals));
    if (!option || !takes_value(*option)) return {};
    return joined(offered_values(*option, facts, word.substr(equals + 1)),
                  word.substr(0, equals + 1));
  }
  if (Offer commands = offered_commands(*place.at); !commands.words.empty()) return commands;
  if (const CLI::Option* argument = place.argument()) return offered_values(*argument, facts, word);
  return offered_options(place, facts);
}

}  // namespace

std::string completion(const App& app, const Facts& facts, const std::vector<std::string>& typed) {
  if (typed.empty()) return "words\n";
  Place place{.at = &app};
  for (std::size_t i = 0; i + 1 < typed.size(); ++i) place.pass(typed[i]);
  const Offer offer = offer_for(place, typed.back(), facts);
  std::string lines = offer.kind + "\n";
  for (const Suggestion& word : offer.words)
    if (word.word.starts_with(typed.back())) lines += word.word + "\t" + word.doc + "\n";
  return lines;
}

}  // namespace microswarm::cli
