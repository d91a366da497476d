// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "microswarm/config/type.hpp"
#include "microswarm/config/yaml_node.hpp"

namespace microswarm {

/// What is wrong in a document.
struct Mistakes {
  std::vector<std::string> lines;
  std::vector<std::string> keys;  ///< of the document, in whose values they are

  bool empty() const { return lines.empty(); }
  void add(const std::string& key, const std::string& line);
  /// Throws InputError with all of them, if there are any.
  void require_none() const;
};

/// Reads parsed YAML into described values, and words every complaint.
class ValueReader {
 public:
  /// `name` stands before every message; with `places`, the node's line and column follow it.
  ValueReader(std::string_view name, bool places) : name_(name), places_(places) {}

  /// Reads the node into the value of that type; `info` gives unit and range to the numbers in it,
  /// `label` names it in messages and is empty for a whole document.
  void read(const Type& type, const FieldInfo& info, std::string_view label, void* value,
            const YamlNode& node);
  /// What was wrong in records and lists, which are read to their ends.
  const Mistakes& mistakes() const { return mistakes_; }

  /// Brings a variant (or the variant in an optional) to the alternative that the node names.
  void choose(const Type& type, std::string_view label, void* value, const YamlNode& node);

  [[noreturn]] void fail(const YamlNode& node, const std::string& what) const;
  [[noreturn]] void fail_unknown_key(const Type& record, const YamlNode& key) const;

 private:
  void read_number(const FieldInfo& info, std::string_view label, double& value,
                   const YamlNode& node);
  template <class Int>
  void read_whole(const FieldInfo& info, std::string_view label, Int& value, const YamlNode& node);
  /// The node's number as it stands, finite and within the range.
  long double checked_number(const Type& type, const FieldInfo& info, const Range& range,
                             std::string_view label, const YamlNode& node);
  void read_list(const Type& type, const FieldInfo& info, std::string_view label, void* value,
                 const YamlNode& node);
  void read_record(const Type& type, std::string_view label, void* value, const YamlNode& node,
                   bool has_type_key);
  void read_variant(const Type& type, std::string_view label, void* value, const YamlNode& node);
  [[noreturn]] void fail_kind(const Type& type, std::string_view label, const YamlNode& node);

  /// Calls `body`, whose InputError is one more mistake.
  template <class Body>
  void attempt(Body&& body);

  std::string_view name_;
  bool places_;
  std::string key_;  ///< of the document, that is being read
  Mistakes mistakes_;
};

}  // namespace microswarm
