// SPDX-License-Identifier: Apache-2.0
#include "support/command.hpp"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <concepts>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/choices.hpp"
#include "microswarm/core/text/text.hpp"
#include "support/cli.hpp"
#include "support/completion.hpp"
#include "support/describe.hpp"
#include "support/help_text.hpp"
#include "support/input_file.hpp"
#include "support/option_names.hpp"
#include "support/options.hpp"
#include "support/usage.hpp"

namespace microswarm::cli {
namespace {

std::string value_text(double value) { return number_text(value); }
std::string value_text(const std::string& value) { return value; }
std::string value_text(const std::vector<std::string>& values) {
  return fmt::format("{}", fmt::join(values, ","));
}
template <std::integral T>
std::string value_text(T value) {
  return std::to_string(value);
}
template <class T>
std::string value_text(const std::optional<T>& value) {
  return value ? value_text(*value) : "";
}

/// CLI11's help, with repetition and default behind the meaning of an option.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(const Facts& facts) : facts_(&facts) {}
  std::string make_option_desc(const CLI::Option* option) const override {
    return meaning(*option, *facts_);
  }

 private:
  const Facts* facts_;
};

/// Whether the words are a command and those below it.
bool names_command(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* at = &app;
  for (const std::string& word : words) {
    const auto found = at->get_subcommands([&](const CLI::App* c) { return c->check_name(word); });
    if (found.empty()) return false;
    at = found.front();
  }
  return true;
}

/// All options of the command that was given.
std::vector<std::string> options_of_given(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const CLI::App* command : app.get_subcommands())
    std::ranges::move(options_of_given(*command), std::back_inserter(names));
  return names;
}

}  // namespace

Check number(double lo, double hi) {
  return {[lo, hi](const std::string& text) -> std::string {
    const std::optional<double> value = parse_number(text);
    if (!value) return "must be a number, not " + quote(text);
    if (*value >= lo && *value <= hi) return {};
    return fmt::format("is {}, allowed {}..{}", text, number_text(lo), number_text(hi));
  }};
}

Check whole(std::uint64_t lo, std::uint64_t hi) {
  return {[lo, hi](const std::string& text) -> std::string {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size() && value >= lo && value <= hi)
      return {};
    return fmt::format("must be a whole number {}..{}, not {}", lo, hi, quote(text));
  }};
}

Check any_word(const std::vector<std::string>& words) {
  return {[words](const std::string& text) -> std::string {
            if (std::find(words.begin(), words.end(), text) != words.end()) return {};
            const std::vector<std::string_view> views(words.begin(), words.end());
            return fmt::format("is {}, {}", quote(text), allowed_words(text, views));
          },
          words};
}

Check file_kind(const std::vector<std::string>& kinds) {
  return {[kinds](const std::string& text) -> std::string {
    const std::string kind = std::filesystem::path(text).extension().string();
    if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return {};
    return fmt::format("must be a file {}, not {}", fmt::join(kinds, ", "), quote(text));
  }};
}

Check place(std::size_t most, const char* form) {
  return {[most, form](const std::string& text) -> std::string {
    const std::size_t count = numbers(text).size();
    if (count >= 2 && count <= most) return {};
    return fmt::format("must be {}, not {}", form, quote(text));
  }};
}

Suggest suggest_words(const std::vector<std::string>& words) {
  return [words](const std::string&) {
    std::vector<Suggestion> all;
    all.reserve(words.size());
    for (const std::string& word : words) all.push_back({word, {}});
    return all;
  };
}

Option Option::required() {
  option_->required();
  return *this;
}

Option Option::type_name(const char* name) {
  option_->type_name(name);
  return *this;
}

Option Option::check(const Check& check) {
  const std::string shown =
      check.words.empty() ? "" : fmt::format("{{{}}}", fmt::join(check.words, ","));
  option_->check(
      CLI::Validator([wrong = check.wrong](std::string& text) { return wrong(text); }, shown));
  if (!check.words.empty()) facts_->words = check.words;
  return *this;
}

Option Option::needs(Option other) {
  option_->needs(other.option_);
  return *this;
}

Option Option::needs(const char* other) {
  option_->needs(other);
  return *this;
}

Option Option::excludes(Option other) {
  option_->excludes(other.option_);
  return *this;
}

Option Option::excludes(const char* other) {
  option_->excludes(other);
  return *this;
}

Option Option::default_text(const char* text) {
  facts_->default_text = text;
  return *this;
}

Option Option::repeatable() {
  option_->take_all()->allow_extra_args(false);
  return *this;
}

Option Option::input(const char* kind) {
  option_->transform(CLI::Validator(
      [kind = std::string(kind)](std::string& text) {
        if (!text.empty()) text = find_input(text, kind);
        return std::string();
      },
      ""));
  return *this;
}

Option Option::suggest(const Suggest& values) {
  facts_->suggest = values;
  return *this;
}

Command Command::add_command(const char* name, const char* doc, const char* example) {
  CLI::App* command = app_->add_subcommand(name, doc);
  command->footer(std::string(example_head) + "  microswarm " + example);
  return {command, facts_};
}

void Command::hide() { app_->group(""); }

void Command::former_name(const char* name) { app_->alias(name); }

Command Command::add_group(const char* name, const char* doc) {
  CLI::App* group = app_->add_subcommand(name, doc);
  group->require_subcommand(1);
  return {group, facts_};
}

template <class T>
Option Command::add_option(const char* name, T& value, const char* doc) {
  CLI::Option* option = app_->add_option(name, value, doc);
  OptionFacts& facts = (*facts_)[option];
  facts.default_text = value_text(value);
  if constexpr (std::is_same_v<T, std::string>)  // an unset shell variable gives an empty text
    option->check([](const std::string& text) { return text.empty() ? "is empty" : ""; });
  return {option, &facts};
}
template Option Command::add_option(const char*, std::string&, const char*);
template Option Command::add_option(const char*, std::vector<std::string>&, const char*);
template Option Command::add_option(const char*, double&, const char*);
template Option Command::add_option(const char*, int&, const char*);
template Option Command::add_option(const char*, std::uint32_t&, const char*);
template Option Command::add_option(const char*, std::uint64_t&, const char*);
template Option Command::add_option(const char*, std::optional<double>&, const char*);
template Option Command::add_option(const char*, std::optional<int>&, const char*);
template Option Command::add_option(const char*, std::optional<std::uint64_t>&, const char*);

Option Command::add_flag(const char* name, bool& value, const char* doc) {
  CLI::Option* option = app_->add_flag(name, value, doc)->disable_flag_override();
  return {option, &(*facts_)[option]};
}

Option Command::option(const char* name) {
  CLI::Option* option = app_->get_option(name);
  return {option, &(*facts_)[option]};
}

void Command::callback(std::function<void()> given) { app_->callback(std::move(given)); }

CommandLine::CommandLine(const char* name, const char* doc, const std::string& version,
                         const char* footer)
    : app_(std::make_unique<CLI::App>(doc, name)) {
  app_->formatter(std::make_shared<HelpFormatter>(facts_));
  app_->set_version_flag("--version", version, "Print the version and exit");
  app_->set_help_flag("-h,--help", "Print this help and exit");
  app_->require_subcommand(1);
  app_->footer(footer);
}

CommandLine::~CommandLine() = default;

nlohmann::ordered_json CommandLine::description() const { return describe(*app_, facts_); }

std::optional<int> CommandLine::parse(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "complete") {
    put(completion(*app_, facts_, {argv + 2, argv + argc}));
    flush_output();
    return ok;
  }
  std::vector<std::string> words(argv + 1, argv + std::max(argc, 1));
  if (!words.empty() && words.front() == "help") {  // help run: run --help
    words.erase(words.begin());
    if (names_command(*app_, words)) words.emplace_back("--help");  // else it is complained about
  }
  std::ranges::reverse(words);  // as CLI11 wants them
  try {
    app_->parse(std::move(words));
    name_inputs_by_options(options_of_given(*app_));
    return std::nullopt;
  } catch (const CLI::Success& e) {  // --help, --version
    std::ostringstream help;
    const int code = app_->exit(e, help, help);
    put(wrapped_help(help.str(), output_columns()));
    flush_output();
    return code;
  } catch (const CLI::ParseError& e) {
    throw InputError(usage_error(*app_, e));
  }
}

}  // namespace microswarm::cli
