// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace microswarm::cli {

/// What the text of an option must be.
struct Check {
  std::function<std::string(const std::string&)> wrong;  ///< why a text is not; empty when it is
  std::string allowed{};                                 ///< for the help
};

/// A decimal number within lo..hi: "is -3, allowed 0..100".
Check number(double lo, double hi);
/// A whole number within lo..hi.
Check whole(std::uint64_t lo, std::uint64_t hi);
/// One of these words.
Check one_of(const std::vector<std::string>& words);
/// A file's name that ends with one of these, as ".png".
Check file_kind(const std::vector<std::string>& kinds);
/// 2 … `most` numbers with commas between them; `form` says what is meant.
Check place(std::size_t most, const char* form);

/// An option or an argument of a command.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option required();
  Option type_name(const char* name);
  Option check(const Check& check);
  /// It is given only together with the other.
  Option needs(Option other);
  Option needs(const char* other);
  /// Not both are given.
  Option excludes(Option other);
  Option excludes(const char* other);
  /// The help tells the value that it has now.
  Option capture_default();
  /// It may stand several times, with a value each.
  Option repeatable();

 private:
  CLI::Option* option_;
};

/// A command, or a group of commands. What it fills must outlive the parsing.
class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}
  /// A command with what it does in one line and an example of a whole command line.
  Command add_command(const char* name, const char* doc, const char* example);
  /// A group of commands, one of which must be named.
  Command add_group(const char* name, const char* doc);
  /// The name that this command had in earlier versions, which still works.
  void former_name(const char* name);
  /// `name` is "--name", or "name" for an argument. T: std::string, a list of them, double, int, a
  /// whole number, or an optional one of these.
  template <class T>
  Option add_option(const char* name, T& value, const char* doc);
  Option add_flag(const char* name, bool& value, const char* doc);
  Option option(const char* name);
  /// Called when this command was given and all is right with its options.
  void callback(std::function<void()> given);

 private:
  CLI::App* app_;
};

/// The whole command line of the program.
class CommandLine {
 public:
  CommandLine(const char* name, const char* doc, const std::string& version, const char* footer);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  Command root() { return Command(app_.get()); }
  /// The exit code when that is all, as after --help. Throws InputError in one line that says where
  /// help is.
  std::optional<int> parse(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace microswarm::cli
