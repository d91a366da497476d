// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
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
  std::string allowed{};                                 ///< for the help
};

/// A decimal number within lo..hi: "is -3, allowed 0..100".
Check number(double lo, double hi);
/// An integer within lo..hi.
Check whole(std::uint64_t lo, std::uint64_t hi);
/// One of these `words`.
Check one_of(const std::vector<std::string>& words);
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
/// Completions of the options that define their own.
using Suggestions = std::map<const CLI::Option*, Suggest>;

/// Completes to these words.
Suggest suggest_words(const std::vector<std::string>& words);

/// An option or an argument of a command.
class Option {
 public:
  Option(CLI::Option* option, Suggestions* suggestions)
      : option_(option), suggestions_(suggestions) {}
  Option required();
  Option type_name(const char* name);
  Option check(const Check& check);
  /// Valid only together with the other option.
  Option needs(Option other);
  Option needs(const char* other);
  /// Not valid together with the other option.
  Option excludes(Option other);
  Option excludes(const char* other);
  /// Shows the current value as default in the help.
  Option capture_default();
  /// May be given several times, with one value each.
  Option repeatable();
  /// Sets the completions. Not needed for FILE, FOLDER and a Check of words.
  Option suggest(const Suggest& values);

 private:
  CLI::Option* option_;
  Suggestions* suggestions_;
};

/// A command, or a group of commands. The variables it fills must outlive the parsing.
class Command {
 public:
  Command(CLI::App* app, Suggestions* suggestions) : app_(app), suggestions_(suggestions) {}
  /// Adds a command with a one-line description and an example command line.
  Command add_command(const char* name, const char* doc, const char* example);
  /// Adds a group of commands, one of which must be named.
  Command add_group(const char* name, const char* doc);
  /// Adds a name of earlier versions, which still works.
  void former_name(const char* name);
  /// Adds an option "--name" or an argument "name". T: std::string, a list of strings, double, int,
  /// an unsigned integer, or an optional number.
  template <class T>
  Option add_option(const char* name, T& value, const char* doc);
  Option add_flag(const char* name, bool& value, const char* doc);
  Option option(const char* name);
  /// Sets the function called if this command was given and its options are valid.
  void callback(std::function<void()> given);

 private:
  CLI::App* app_;
  Suggestions* suggestions_;
};

/// The complete command line of the program.
class CommandLine {
 public:
  CommandLine(const char* name, const char* doc, const std::string& version, const char* footer);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  Command root() { return {app_.get(), &suggestions_}; }
  /// Parses the command line. Returns the exit code if the work is done, as after --help.
  /// `complete WORD...` prints the completions of the last word, see `completion`. Throws a
  /// one-line InputError that refers to the help.
  std::optional<int> parse(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
  Suggestions suggestions_;
};

}  // namespace microswarm::cli
