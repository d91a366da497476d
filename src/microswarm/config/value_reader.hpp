// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "microswarm/config/type.hpp"
#include "microswarm/config/yaml_node.hpp"

namespace microswarm {

/// Mistakes found in a document.
struct Mistakes {
  std::vector<std::string> lines;
  std::vector<std::string> keys;  ///< top-level keys whose values contain them

  bool empty() const { return lines.empty(); }
  void add(const std::string& key, const std::string& line);
  /// Throws InputError with all lines, if any.
  void require_none() const;
};

/// Reads parsed YAML into described values and writes the error messages.
class ValueReader {
 public:
  /// `name` begins every message; with `places`, the node's line and column follow it.
  ValueReader(std::string_view name, bool places) : name_(name), places_(places) {}

  /// Reads the node into a value of this type. `info` gives unit and range of the numbers in it;
  /// `label` names it in messages and is empty for a whole document.
  void read(const Type& type, const FieldInfo& info, std::string_view label, void* value,
            const YamlNode& node);
  /// Mistakes in records and lists, which are read to the end.
  const Mistakes& mistakes() const { return mistakes_; }

  /// Switches a variant (or an optional's variant) to the alternative named by the node.
  void choose(const Type& type, std::string_view label, void* value, const YamlNode& node);

  [[noreturn]] void fail(const YamlNode& node, const std::string& what) const;
  [[noreturn]] void fail_unknown_key(const Type& record, const YamlNode& key) const;

 private:
  void read_number(const FieldInfo& info, std::string_view label, double& value,
                   const YamlNode& node);
  template <class Int>
  void read_whole(const FieldInfo& info, std::string_view label, Int& value, const YamlNode& node);
  /// Number in the node, finite and within the range, not yet converted.
  long double checked_number(const Type& type, const FieldInfo& info, const Range& range,
                             std::string_view label, const YamlNode& node);
  void read_list(const Type& type, const FieldInfo& info, std::string_view label, void* value,
                 const YamlNode& node);
  void read_record(const Type& type, std::string_view label, void* value, const YamlNode& node,
                   bool has_type_key);
  void read_variant(const Type& type, std::string_view label, void* value, const YamlNode& node);
  [[noreturn]] void fail_kind(const Type& type, std::string_view label, const YamlNode& node);

  /// Calls `body` and adds its InputError to the mistakes.
  template <class Body>
  void attempt(Body&& body);

  std::string_view name_;
  bool places_;
  std::string key_;  ///< top-level key being read
  Mistakes mistakes_;
};

}  // namespace microswarm
