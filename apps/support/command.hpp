// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace microswarm::cli {

/// Condition on the text of an option.
struct Check {
  std::function<std::string(const std::string&)> wrong;  ///< error message; empty if valid
  std::vector<std::string> words{};                      ///< the valid ones, if there are few
};

/// A decimal number within lo..hi: "is -3, allowed 0..100".
Check number(double lo, double hi);
/// An integer within lo..hi.
Check whole(std::uint64_t lo, std::uint64_t hi);
/// One of these `words`.
Check any_word(const std::vector<std::string>& words);
/// A file name with one of these extensions, such as ".png".
Check file_kind(const std::vector<std::string>& kinds);
/// 2 … `most` numbers separated by commas; `form` describes the format.
Check place(std::size_t most, const char* form);

/// A word that shell completion offers, and its description.
struct Suggestion {
  std::string word;
  std::string doc;
};
/// Function that returns the completions of a typed beginning.
using Suggest = std::function<std::vector<Suggestion>(const std::string& typed)>;

/// Facts about an option that the parser does not need.
struct OptionFacts {
  std::string default_text;        ///< value without the option, or words for it; empty: none
  std::vector<std::string> words;  ///< the values it takes, if they are words
  Suggest suggest;                 ///< values that a shell offers; null: by words and value name
};
using Facts = std::map<const CLI::Option*, OptionFacts>;

/// Completes to these words.
Suggest suggest_words(const std::vector<std::string>& words);

/// An option or an argument of a command.
class Option {
 public:
  Option(CLI::Option* option, OptionFacts* facts) : option_(option), facts_(facts) {}
  Option required();
  Option type_name(const char* name);
  Option check(const Check& check);
  /// Valid only together with the other option.
  Option needs(Option other);
  Option needs(const char* other);
  /// Not valid together with the other option.
  Option excludes(Option other);
  Option excludes(const char* other);
  /// Text of the default, where the variable does not state it: "one per core".
  Option default_text(const char* text);
  /// May be given several times, with one value each.
  Option repeatable();
  /// It names a file that is read: "-" is standard input, and a shipped file is found by its name,
  /// in the folder `kind` of the shipped scenarios or beside them (find_input).
  Option input(const char* kind = "");
  /// Sets the completions. Not needed for FILE, FOLDER and a Check of words.
  Option suggest(const Suggest& values);

 private:
  CLI::Option* option_;
  OptionFacts* facts_;
};

/// A command, or a group of commands. The variables it fills must outlive the parsing.
class Command {
 public:
  Command(CLI::App* app, Facts* facts) : app_(app), facts_(facts) {}
  /// Adds a command with a one-line description and an example command line.
  Command add_command(const char* name, const char* doc, const char* example);
  /// Adds a group of commands, one of which must be named.
  Command add_group(const char* name, const char* doc);
  /// Leaves the command out of the list of commands.
  void hide();
  /// Name of this command in earlier versions, which still works.
  void former_name(const char* name);
  /// Adds an option "--name" or an argument "name". T: std::string, a list of strings, double, int,
  /// an unsigned integer, or an optional number. The current value is shown as its default.
  template <class T>
  Option add_option(const char* name, T& value, const char* doc);
  Option add_flag(const char* name, bool& value, const char* doc);
  Option option(const char* name);
  /// Sets the function called if this command was given and its options are valid.
  void callback(std::function<void()> given);

 private:
  CLI::App* app_;
  Facts* facts_;
};

/// The complete command line of the program.
class CommandLine {
 public:
  CommandLine(const char* name, const char* doc, const std::string& version, const char* footer);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  Command root() { return {app_.get(), &facts_}; }
  /// The program as data: its commands with their options and arguments, below `commands`.
  nlohmann::ordered_json description() const;
  /// Parses the command line. Returns the exit code if nothing remains to be done, as after --help.
  /// `complete WORD...` prints what a shell offers for the last word, as `completion` says.
  /// Throws a one-line InputError that refers to the help.
  std::optional<int> parse(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
  Facts facts_;
};

}  // namespace microswarm::cli
