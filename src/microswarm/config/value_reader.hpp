// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "microswarm/config/type.hpp"
#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/errors/issue.hpp"

namespace microswarm {

/// Reads parsed YAML or JSON into described values and writes the error messages.
class ValueReader {
 public:
  /// `name` is the location of every issue; with `locations`, the node's line and column follow it.
  /// `key` is that of the value read; empty for a whole document.
  ValueReader(std::string_view name, bool locations, std::string key = {})
      : name_(name), locations_(locations), key_(std::move(key)) {}

  /// Reads the node into a value of this type. `info` gives unit and range of the numbers in it;
  /// `label` names it in messages and is empty for a whole document.
  void read(const Type& type, const FieldInfo& info, std::string_view label, void* value,
            const YamlNode& node);
  /// Mistakes in records and lists, which are read to the end; the thousandth ends it with an
  /// InputError.
  const Issues& issues() const { return issues_; }

  /// Switches a variant (or an optional's variant) to the alternative named by the node.
  void choose(const Type& type, std::string_view label, void* value, const YamlNode& node);

  /// Throws an issue of the current key. `value` is as written.
  [[noreturn]] void fail(const YamlNode& at, std::string what, std::string value = {},
                         std::string limit = {}) const;
  /// `value` is what the unknown key is given.
  [[noreturn]] void fail_unknown_key(const Type& record, const YamlNode& key, std::string value,
                                     bool has_type_key) const;

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

  /// Calls `body` for the part of that name and adds the issues of its InputError.
  template <class Body>
  void attempt(std::string_view part, Body&& body);

  std::string_view name_;
  bool locations_;
  std::string key_;  ///< being read, from the top: "obstacles.3.shape"
  Issues issues_;
};

}  // namespace microswarm
