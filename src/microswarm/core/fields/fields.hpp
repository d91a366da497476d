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

/// Metadata of one field of a parameter struct, made by the functions of `field_units`. Its key in
/// files and on the command line is the name with the unit's suffix: "step" in µm has the key
/// `step_um`.
struct FieldInfo {
  std::string_view name{};
  Unit unit = Unit::none;
  Range range{};
  std::string_view doc{};
  bool required = false;          ///< must be given: no sensible default
  std::string_view former_key{};  ///< key in earlier versions, still accepted

  constexpr FieldInfo() = default;
  constexpr FieldInfo(Unit of, std::string_view called, Range within, std::string_view about)
      : name(called), unit(of), range(within), doc(about) {}
  constexpr FieldInfo(Unit of, std::string_view called, std::string_view about)
      : FieldInfo(of, called, Range{}, about) {}
  constexpr FieldInfo(Unit of, std::string_view called, auto min, auto max, std::string_view about)
      : FieldInfo(of, called, {static_cast<double>(min), static_cast<double>(max)}, about) {}

  /// The same field, which must be given.
  constexpr FieldInfo needed() const {
    FieldInfo info = *this;
    info.required = true;
    return info;
  }
  /// The same field, which is also read from the key that it had in earlier versions.
  constexpr FieldInfo formerly(std::string_view key) const {
    FieldInfo info = *this;
    info.former_key = key;
    return info;
  }
};

/// Name of a field, without the suffix of its unit.
using FieldName = std::string_view;

inline namespace field_units {

/// A field in one of the units; `plain`: without a unit. After the name stand both ends of its
/// range, or a Range, or nothing if there is no limit; then its doc:
///
///     um("step", 1, 1e5, "Length of one extension.")
///     plain("goal", "Where it ends.").needed()
///     deg("max_turn", 30, 180, "Largest turn.").formerly("most_turn_deg")
///
/// Where a member hides the function, write `field_units::s`.
constexpr FieldInfo plain(FieldName n, auto... of) { return {Unit::none, n, of...}; }
constexpr FieldInfo um(FieldName n, auto... of) { return {Unit::um, n, of...}; }
constexpr FieldInfo s(FieldName n, auto... of) { return {Unit::s, n, of...}; }
constexpr FieldInfo hz(FieldName n, auto... of) { return {Unit::hz, n, of...}; }
constexpr FieldInfo rad(FieldName n, auto... of) { return {Unit::rad, n, of...}; }
constexpr FieldInfo deg(FieldName n, auto... of) { return {Unit::deg, n, of...}; }
constexpr FieldInfo um_per_s(FieldName n, auto... of) { return {Unit::um_per_s, n, of...}; }
constexpr FieldInfo deg_per_s(FieldName n, auto... of) { return {Unit::deg_per_s, n, of...}; }
constexpr FieldInfo per_s(FieldName n, auto... of) { return {Unit::per_s, n, of...}; }
constexpr FieldInfo um2(FieldName n, auto... of) { return {Unit::um2, n, of...}; }
constexpr FieldInfo px(FieldName n, auto... of) { return {Unit::px, n, of...}; }
constexpr FieldInfo um_per_px(FieldName n, auto... of) { return {Unit::um_per_px, n, of...}; }
constexpr FieldInfo ms(FieldName n, auto... of) { return {Unit::ms, n, of...}; }
constexpr FieldInfo mt(FieldName n, auto... of) { return {Unit::mt, n, of...}; }
constexpr FieldInfo mt_per_a(FieldName n, auto... of) { return {Unit::mt_per_a, n, of...}; }
constexpr FieldInfo t_per_m(FieldName n, auto... of) { return {Unit::t_per_m, n, of...}; }
constexpr FieldInfo t_per_m_per_a(FieldName n, auto... of) {
  return {Unit::t_per_m_per_a, n, of...};
}
constexpr FieldInfo a(FieldName n, auto... of) { return {Unit::a, n, of...}; }
constexpr FieldInfo a_per_s(FieldName n, auto... of) { return {Unit::a_per_s, n, of...}; }
constexpr FieldInfo v(FieldName n, auto... of) { return {Unit::v, n, of...}; }
constexpr FieldInfo ohm(FieldName n, auto... of) { return {Unit::ohm, n, of...}; }
constexpr FieldInfo mh(FieldName n, auto... of) { return {Unit::mh, n, of...}; }
constexpr FieldInfo degc(FieldName n, auto... of) { return {Unit::degc, n, of...}; }
constexpr FieldInfo k_per_w(FieldName n, auto... of) { return {Unit::k_per_w, n, of...}; }
constexpr FieldInfo per_k(FieldName n, auto... of) { return {Unit::per_k, n, of...}; }

}  // namespace field_units

/// Key of a field: its name with the unit's suffix.
std::string key_text(const FieldInfo& info);

/// A key that stood elsewhere in earlier versions, in a part of the document: it is read there
/// still. One that had no effect and is gone is ignored there. A struct lists them as
/// `static constexpr std::array<MovedKey, N> moved_keys`.
struct MovedKey {
  std::string_view from{};  ///< "navigator.frame_timeout_s"
  std::string_view to{};    ///< "sensing.frame_timeout_s"; empty when it is gone
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
///       visit(self.step, um("step", 1, 1e5, "Length of one extension."));
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
