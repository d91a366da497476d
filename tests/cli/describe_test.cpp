// SPDX-License-Identifier: Apache-2.0
// The program as data, which its reference and manual are written from.
#include <functional>
#include <nlohmann/json.hpp>

#include "inputs.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

using DescribedJson = nlohmann::json;

class Description : public CommandLine {
 protected:
  /// Calls `look(words, command)` for every command, of which `words` are the names.
  void each_command(const std::function<void(const Arguments&, const DescribedJson&)>& look) {
    const std::function<void(Arguments, const DescribedJson&)> down =
        [&](Arguments words, const DescribedJson& command) {
          look(words, command);
          for (const DescribedJson& below : command.at("commands")) {
            Arguments longer = words;
            longer.push_back(below.at("name"));
            down(longer, below);
          }
        };
    down({}, all_.at("program"));
  }
  DescribedJson option_of(const Arguments& words, const std::string& name) {
    DescribedJson found;
    each_command([&](const Arguments& path, const DescribedJson& command) {
      for (const DescribedJson& option : command.at("options"))
        if (path == words && option.at("names").back() == name) found = option;
    });
    return found;
  }

  DescribedJson all_ = DescribedJson::parse(good({"describe", "--json"}));
};

/// What the help says behind the name of an option.
std::string meaning_in_help(const DescribedJson& option) {
  const std::string value = option.at("default");
  std::string text = option.at("doc");
  if (option.at("repeatable")) text += " (repeatable)";
  if (value != "none" && value != "off" && value != "required") text += " (default: " + value + ")";
  return text + "\n";
}

TEST_F(Description, EveryOptionHasADocAndADefaultThatTheHelpShows) {
  std::size_t count = 0;
  each_command([&](const Arguments& words, const DescribedJson& command) {
    Arguments asked = words;
    asked.push_back("--help");
    const std::string help = good(asked);
    DescribedJson options = command.at("arguments");
    for (const DescribedJson& option : command.at("options")) options.push_back(option);
    for (const DescribedJson& option : options) {
      const std::string name = testing::PrintToString(words) + option.at("names").dump();
      const std::string value = option.at("default"), doc = option.at("doc");
      EXPECT_FALSE(doc.empty()) << name;
      EXPECT_EQ(doc.find("(default"), std::string::npos) << name << ": " << doc;
      EXPECT_FALSE(value.empty()) << name;
      EXPECT_EQ(value == "required", option.at("required").get<bool>()) << name;
      EXPECT_EQ(value == "off", option.at("value") == "") << name;
      EXPECT_NE(help.find(meaning_in_help(option)), std::string::npos) << name << "\n" << help;
      ++count;
    }
  });
  EXPECT_GT(count, 200U);
}

TEST_F(Description, DefaultsAreThoseThatHold) {
  EXPECT_EQ(option_of({"rig", "drive"}, "--seconds").at("default"), "5");
  EXPECT_EQ(option_of({"rig", "drive"}, "--ramp").at("default"), "0.5");
  EXPECT_EQ(option_of({"report"}, "--to").at("default"), "the run's end");
  EXPECT_EQ(option_of({"rig", "drive"}, "--each").at("default"), "none");
  const DescribedJson plane = option_of({"rig", "map"}, "--plane");
  EXPECT_EQ(plane.at("words"), DescribedJson({"xy", "xz", "yz"}));
  EXPECT_EQ(plane.at("default"), "xy");
  EXPECT_EQ(option_of({"run"}, "--set").at("value"), "KEY=VALUE");
  EXPECT_TRUE(option_of({"run"}, "--set-rig").at("repeatable"));
  EXPECT_EQ(option_of({"run"}, "--trials").at("excludes"), DescribedJson({"--rig"}));

  write("maze.map", "type octile\nheight 4\nwidth 4\nmap\n....\n.@@.\n.@@.\n....\n");
  Arguments words{"plan",
                  "maze.map",
                  "--um-per-px",
                  "500",
                  "--start",
                  "250,250",
                  "--goal",
                  "1750,1750",
                  "--json",
                  "--set",
                  "planner.type=drrt_star"};
  const DescribedJson plain = DescribedJson::parse(good(words));
  words.insert(words.end(), {"--seed", option_of({"plan"}, "--seed").at("default")});
  EXPECT_EQ(DescribedJson::parse(good(words)).at("path_um"), plain.at("path_um"));
}

TEST_F(Description, EveryCommandHasAnExample) {
  each_command([&](const Arguments& words, const DescribedJson& command) {
    if (!command.at("commands").empty()) return;
    std::string name = "  microswarm";
    for (const std::string& word : words) name += " " + word;
    Arguments asked = words;
    asked.push_back("--help");
    EXPECT_TRUE(command.at("example").get<std::string>().starts_with(name)) << name;
    EXPECT_NE(good(asked).find("Example:\n" + name), std::string::npos) << name;
  });
}

TEST_F(Description, KeysAreThoseOfTheTable) {
  for (const auto& [kind, keys] : all_.at("keys").items()) {
    std::string lines;
    const std::function<void(const DescribedJson&)> list = [&](const DescribedJson& level) {
      for (const DescribedJson& key : level) {
        EXPECT_FALSE(key.at("doc").empty()) << kind << " " << key.at("key");
        lines += key.at("key").get<std::string>() + "\n";
        list(key.at("keys"));
        for (const DescribedJson& type : key.at("types")) {
          lines += "type: " + type.at("type").get<std::string>() + "\n";
          list(type.at("keys"));
        }
      }
    };
    list(keys);
    std::string shown;
    const std::string table = good({"schema", kind, "--keys"});
    for (std::size_t begun = table.find('\n') + 1; begun < table.size();
         begun = table.find('\n', begun) + 1) {
      const std::string line = table.substr(begun, table.find('\n', begun) - begun);
      const std::size_t begin = line.find_first_not_of(' ');
      const bool is_type = line.compare(begin, 6, "type: ") == 0;
      shown += line.substr(begin, is_type ? line.npos : line.find(' ', begin) - begin) + "\n";
    }
    EXPECT_EQ(lines, shown) << kind;
  }
  EXPECT_EQ(all_.at("keys").size(), 7U);
}

TEST_F(Description, TheCommandItselfIsNotListed) {
  EXPECT_EQ(good({"--help"}).find("describe "), std::string::npos);
  EXPECT_EQ(good({"complete", ""}).find("describe"), std::string::npos);
  EXPECT_EQ(run({"fly"}).err.find("describe"), std::string::npos);
  refused({"describe"}, naming("", {"--json", "microswarm describe --help"}));
}

}  // namespace
}  // namespace microswarm::test
