// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/yaml_node.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/core/text/utf8.hpp"

namespace microswarm {
namespace {

/// yaml-cpp writes the escapes "\_" and "\N" as one byte of Latin-1 each: the text in UTF-8.
std::string with_whole_characters(const std::string& value) {
  std::string text;
  for (std::string_view rest = value; !rest.empty();) {
    const Utf8Character next = first_character(rest);
    const auto byte = static_cast<unsigned char>(rest.front());
    if (next.code)
      text += rest.substr(0, next.bytes);
    else
      text += {static_cast<char>(0xc0 | byte >> 6), static_cast<char>(0x80 | (byte & 0x3f))};
    rest.remove_prefix(next.bytes);
  }
  return text;
}

constexpr std::size_t max_depth = 64;
constexpr std::size_t max_values = 2'000'000;

/// Builds the tree from the parser's events. `open_` may point into `items`: only the items of the
/// innermost open node grow.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::string_view name) : name_(name) {}

  YamlNode take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(mark, "a second document begins, only one is allowed");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    YamlNode& node = add(YamlNode::Kind::null, mark, "", anchor);
    if (open_.empty() || open_.back()->kind != YamlNode::Kind::map) return;
    const std::vector<YamlNode>& items = open_.back()->items;
    if (items.size() % 2 != 0) return;
    const YamlNode& key = items[items.size() - 2];  // a missing value has its key's position
    node.line = key.line;
    node.column = key.column;
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    fail(mark, "aliases (*name) are not supported");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlNode& node = add(YamlNode::Kind::scalar, mark, tag, anchor);
    node.text = with_whole_characters(value);
    node.quoted = tag == "!";
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(add(YamlNode::Kind::list, mark, tag, anchor), mark);
  }
  void OnSequenceEnd() override { open_.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(add(YamlNode::Kind::map, mark, tag, anchor), mark);
  }
  void OnMapEnd() override {
    check_keys(*open_.back());
    open_.pop_back();
  }

 private:
  [[noreturn]] void fail(int line, int column, const std::string& what) const {
    throw InputError(std::string(name_), line, column, what);
  }
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    fail(mark.line + 1, mark.column + 1, what);
  }

  YamlNode& add(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
                YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) fail(mark, "anchors (&name) are not supported");
    if (!tag.empty() && tag != "?" && tag != "!") fail(mark, "tags (!name) are not supported");
    if (++values_ > max_values) fail(mark, fmt::format("more than {} values", max_values));
    YamlNode& node = open_.empty() ? root_ : open_.back()->items.emplace_back();
    node.kind = kind;
    node.line = mark.line + 1;
    node.column = mark.column + 1;
    return node;
  }

  void open(YamlNode& node, const YAML::Mark& mark) {
    if (open_.size() == max_depth) fail(mark, fmt::format("nested deeper than {}", max_depth));
    open_.push_back(&node);
  }

  void check_keys(const YamlNode& map) const {
    std::vector<const YamlNode*> keys;
    for (std::size_t i = 0; i < map.items.size(); i += 2) {
      const YamlNode& key = map.items[i];
      if (key.kind != YamlNode::Kind::scalar) fail(key.line, key.column, "a key must be a word");
      if (key.text == "<<")
        fail(key.line, key.column, "merge keys (<<) are not supported: write the keys out");
      keys.push_back(&key);
    }
    std::stable_sort(keys.begin(), keys.end(),
                     [](const YamlNode* a, const YamlNode* b) { return a->text < b->text; });
    const auto twin =
        std::adjacent_find(keys.begin(), keys.end(),
                           [](const YamlNode* a, const YamlNode* b) { return a->text == b->text; });
    if (twin == keys.end()) return;
    const YamlNode &first = **twin, &second = **(twin + 1);
    fail(second.line, second.column,
         fmt::format("key {} given twice, first in line {}", quote(second.text), first.line));
  }

  std::string_view name_;
  YamlNode root_;
  std::vector<YamlNode*> open_;
  std::size_t values_ = 0;
  int documents_ = 0;
};

/// Length of the UTF-8 character at the start of `text`; 0 if there is none, or for a control
/// character not allowed in a text file.
std::size_t character_length(std::string_view text) {
  const auto [code, bytes] = first_character(text);
  return code && (*code >= 0x20 || *code == '\t' || *code == '\n' || *code == '\r') ? bytes : 0;
}

/// Throws InputError if a line up to `last` is indented by a tab, which the parser complains about
/// in other words.
void fail_at_tab(std::string_view text, std::string_view name, int last) {
  for (int line = 1; line <= last && !text.empty(); ++line) {
    const std::string_view row = text.substr(0, text.find('\n'));
    const std::size_t content = row.find_first_not_of(" \t\r");
    const std::size_t tab = row.substr(0, content).find('\t');
    if (content != std::string_view::npos && row[content] != '#' && tab != std::string_view::npos)
      throw InputError(std::string(name), line, static_cast<int>(tab) + 1,
                       "a tab indents this line: YAML is indented by blanks only");
    text.remove_prefix(std::min(row.size() + 1, text.size()));
  }
}

}  // namespace

void check_characters(std::string_view text, std::string_view name) {
  int line = 1, column = 1;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text.substr(i));
    if (length == 0)
      throw InputError(
          std::string(name), line, column,
          fmt::format("byte 0x{:02x} is not text in UTF-8", static_cast<unsigned char>(text[i])));
    ++column;
    if (text[i] == '\n') ++line, column = 1;
    i += length;
  }
}

YamlNode parse_yaml(std::string_view text, std::string_view name) {
  if (text.size() > max_yaml_bytes)
    throw InputError(std::string(name),
                     fmt::format("larger than the allowed {} bytes", max_yaml_bytes));
  if (text.starts_with("\x89HDF"))
    throw InputError(std::string(name),
                     "is a record, not text: " + input_name("read_record") + " takes it");
  check_characters(text, name);
  TreeBuilder builder(name);
  try {
    std::istringstream stream{std::string(text)};
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    fail_at_tab(text, name, error.mark.line + 1);
    throw InputError(std::string(name), error.mark.line + 1, error.mark.column + 1,
                     "YAML: " + error.msg);
  }
  return builder.take_root();
}

std::string flow_text(const YamlNode& node) {
  std::vector<std::string> items;
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "null";
    case YamlNode::Kind::scalar:
      return node.quoted ? nlohmann::json(node.text).dump() : node.text;
    case YamlNode::Kind::list:
      for (const YamlNode& item : node.items) items.push_back(flow_text(item));
      return fmt::format("[{}]", fmt::join(items, ", "));
    case YamlNode::Kind::map:
      for (std::size_t i = 0; i < node.items.size(); i += 2)
        items.push_back(flow_text(node.items[i]) + ": " + flow_text(node.items[i + 1]));
      return fmt::format("{{{}}}", fmt::join(items, ", "));
  }
  return "";
}

std::string shown_value(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::null) return {};
  return one_line(node.kind == YamlNode::Kind::scalar ? node.text : flow_text(node));
}

}  // namespace microswarm
