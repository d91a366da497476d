// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "microswarm/core/fields/units.hpp"

namespace microswarm {

/// Range of a parameter in its displayed unit; both ends are allowed.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// Metadata of one field of a parameter struct. Its key in files and on the command line is the
/// name with the unit's suffix: "step" in µm has the key `step_um`.
struct FieldInfo {
  std::string_view name;
  Unit unit = Unit::none;
  Range range{};
  std::string_view doc;
  bool required = false;          ///< must be given: no sensible default
  std::string_view former_key{};  ///< key in earlier versions, still accepted
};

/// Key of a field: its name with the unit's suffix.
std::string key_of(const FieldInfo& info);

/// A key that stood elsewhere in earlier versions, in a part of the document: it is read there
/// still. One that had no effect and is gone is ignored there. A struct lists them as
/// `static constexpr std::array<MovedKey, N> moved_keys`.
struct MovedKey {
  std::string_view from;  ///< "navigator.frame_timeout_s"
  std::string_view to;    ///< "sensing.frame_timeout_s"; empty when it is gone
};

/// Field visitor that does nothing; used by the concept HasFields.
struct NullVisitor {
  template <class T>
  void operator()(T&, const FieldInfo&) {}
};

/// A parameter struct that lists its fields once, in one static member template:
///
///     template <class Self, class Visitor>
///     static void fields(Self& self, Visitor&& visit) {
///       visit(self.step, {"step", Unit::um, {1, 1e5}, "Length of one extension."});
///     }
///
/// YAML, JSON Schema, `--set`, help text and record headers are generated from it.
/// Allowed types: bool, int, std::uint32_t, std::uint64_t, double, std::string, Vec2, Pose2, enums
/// with `enum_names`, structs with `fields`, std::optional and std::vector of these, and
/// std::variant of structs that each have a `static constexpr std::string_view type_name` (selected
/// by the key `type`). Unit and range apply to every number in the field: both coordinates of a
/// Vec2, each entry of a vector.
template <class T>
concept HasFields = requires(T& t, NullVisitor& v) {
  T::fields(t, v);
};

/// An enum usable as a field. It declares its words in its namespace, found by argument-dependent
/// lookup:
///
///     enum class Walls { slide, stop };
///     constexpr auto enum_names(Walls) {
///       return std::array<std::pair<Walls, std::string_view>, 2>{
///           {{Walls::slide, "slide"}, {Walls::stop, "stop"}}};
///     }
template <class E>
concept NamedEnum = std::is_enum_v<E> && requires {
  enum_names(E{});
};

/// Word of an enumerator; empty if it has none.
template <NamedEnum E>
constexpr std::string_view enum_name(E value) {
  for (const auto& [entry, name] : enum_names(value))
    if (entry == value) return name;
  return {};
}

/// Enumerator with this word, or nothing.
template <NamedEnum E>
constexpr std::optional<E> enum_value(std::string_view name) {
  for (const auto& [entry, word] : enum_names(E{}))
    if (word == name) return entry;
  return std::nullopt;
}

}  // namespace microswarm
