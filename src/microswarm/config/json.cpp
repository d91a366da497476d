// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <unordered_set>
#include <vector>

#include "microswarm/config/value_reader.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

/// Builds the tree from the parser's events, each of which returns true to continue. `open_` may
/// point into `items`: only the items of the innermost open node grow.
class JsonBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonBuilder(std::string_view name, std::size_t depth) : name_(name), depth_(depth) {}

  YamlNode take_root() { return std::move(root_); }

  bool null() override { return add(YamlNode::Kind::null, {}); }
  bool boolean(bool value) override { return literal(value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override { return literal(std::to_string(value)); }
  bool number_unsigned(number_unsigned_t value) override { return literal(std::to_string(value)); }
  bool number_float(number_float_t, const string_t& text) override { return literal(text); }
  bool string(string_t& text) override {
    add(YamlNode::Kind::scalar, std::move(text));
    last().quoted = true;
    return true;
  }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override {
    keys_.emplace_back();
    return open(YamlNode::Kind::map);
  }
  bool key(string_t& text) override {
    if (!keys_.back().insert(text).second) fail(fmt::format("key {} given twice", quote(text)));
    return string(text);
  }
  bool end_object() override {
    keys_.pop_back();
    return end_array();
  }
  bool start_array(std::size_t) override { return open(YamlNode::Kind::list); }
  bool end_array() override {
    open_.pop_back();
    return true;
  }
  bool parse_error(std::size_t at, const std::string&, const nlohmann::json::exception&) override {
    fail(fmt::format("not JSON in UTF-8, at byte {}", at));
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(std::string(name_), what);
  }

  YamlNode& last() { return open_.empty() ? root_ : open_.back()->items.back(); }

  bool add(YamlNode::Kind kind, std::string text) {
    if (!open_.empty()) open_.back()->items.emplace_back();
    last().kind = kind;
    last().text = std::move(text);
    return true;
  }
  bool literal(std::string text) {
    add(YamlNode::Kind::scalar, std::move(text));
    return last().literal = true;
  }
  bool open(YamlNode::Kind kind) {
    if (open_.size() == depth_) fail(fmt::format("nested deeper than {}", depth_));
    add(kind, {});
    open_.push_back(&last());
    return true;
  }

  std::string_view name_;
  std::size_t depth_;
  YamlNode root_;
  std::vector<YamlNode*> open_;
  std::vector<std::unordered_set<std::string>> keys_;  ///< of the open objects
};

}  // namespace

YamlNode parse_json(std::string_view text, std::string_view name, const JsonLimits& limits) {
  if (text.size() > limits.bytes)
    throw InputError(std::string(name),
                     fmt::format("{} bytes, at most {} are allowed", text.size(), limits.bytes));
  JsonBuilder builder(name, limits.depth);
  nlohmann::json::sax_parse(text, &builder);
  return builder.take_root();
}

void read_json(const Type& type, void* value, std::string_view text, std::string_view name,
               Issues& issues, const JsonLimits& limits) {
  const YamlNode node = parse_json(text, name, limits);
  if (node.kind != YamlNode::Kind::map) throw InputError(std::string(name), "not an object");
  ValueReader reader(name, false);
  reader.read(type, {}, "", value, node);
  issues.add(reader.issues());
}

}  // namespace microswarm
