// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "microswarm/config/type.hpp"
#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/errors/issue.hpp"

namespace microswarm {

/// Limits of a JSON text from an untrusted source.
struct JsonLimits {
  std::size_t bytes = 256 * 1024;
  std::size_t depth = 64;  ///< of nested objects and lists
};

/// Parses a JSON text (RFC 8259). Throws an InputError of one line, which begins with `name`, for
/// another text, a duplicate key, or a text beyond the limits. Nodes have no line and column.
YamlNode parse_json(std::string_view text, std::string_view name, const JsonLimits& limits = {});

/// Reads a JSON object into the value, as strictly as a YAML file; a text needs its quotes. Values
/// not given by the text are kept. Throws InputError as parse_json; mistakes in keys and values go
/// into `issues`.
void read_json(const Type& type, void* value, std::string_view text, std::string_view name,
               Issues& issues, const JsonLimits& limits = {});

/// The same for a parameter struct.
template <HasFields T>
void read_json(T& value, std::string_view text, std::string_view name, Issues& issues,
               const JsonLimits& limits = {}) {
  read_json(type_of<T>(), &value, text, name, issues, limits);
}

}  // namespace microswarm
