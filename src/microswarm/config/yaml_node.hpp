// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace microswarm {

/// YAML or JSON document as a plain tree with source positions.
struct YamlNode {
  enum class Kind { null, scalar, list, map };
  Kind kind = Kind::null;
  bool quoted = false;            ///< quoted or block scalar: always text
  bool literal = false;           ///< number, true or false of JSON: never text
  int line = 0;                   ///< from 1
  int column = 0;                 ///< from 1
  std::string text{};             ///< scalar
  std::vector<YamlNode> items{};  ///< list: entries; map: key, value, key, value, …

  bool is_plain() const { return kind == Kind::scalar && !quoted; }
};

/// Throws InputError with file:line:column if the text is not UTF-8 or holds a control character
/// other than a tab or a line end.
void check_characters(std::string_view text, std::string_view name);

/// Parses one document; an empty one is null. Throws InputError with file:line:column for text that
/// is not YAML in UTF-8, and for what a parameter file may not contain: anchors, aliases, tags,
/// keys that are not words, duplicate keys, several documents, nesting deeper than 64, more than 16
/// MB or two million values.
YamlNode parse_yaml(std::string_view text, std::string_view name);

/// The value on one line of YAML, as it may stand in an assignment.
std::string flow_text(const YamlNode& node);

/// The value as written, for an issue: on one line of at most 200 bytes; empty for null.
std::string shown_value(const YamlNode& node);

}  // namespace microswarm
