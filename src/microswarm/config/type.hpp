// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Kind of a field's type; see core/fields/fields.hpp.
enum class TypeKind {
  boolean,   ///< bool
  integer,   ///< int
  count,     ///< std::uint64_t
  index,     ///< std::uint32_t
  number,    ///< double
  text,      ///< std::string
  point,     ///< Vec2
  choice,    ///< an enum
  record,    ///< a struct with fields, and Pose2
  optional,  ///< std::optional
  list,      ///< std::vector
  variant    ///< std::variant of structs
};

struct Type;

/// One field of a record: its key and its offset in the struct.
struct Field {
  std::string key{};  ///< name with the unit's suffix
  FieldInfo info{};
  const Type* type = nullptr;
  std::size_t offset = 0;  ///< [bytes]

  const void* in(const void* record) const {
    return static_cast<const std::byte*>(record) + offset;
  }
  void* in(void* record) const { return static_cast<std::byte*>(record) + offset; }
};

/// A `fields` declaration as data. Reading, writing, schema and help interpret it together with a
/// pointer to the value, so they are compiled once for all structs.
struct Type {
  TypeKind kind{};
  std::vector<std::string_view> words{};  ///< choice: its words; variant: its type names
  std::vector<Field> fields{};            ///< record
  std::vector<const Type*> parts{};       ///< optional and list: the content; variant: alternatives
  const void* defaults = nullptr;         ///< record: an instance with every field at its default

  /// list: number of entries; optional: 0 or 1; choice and variant: index of the current word.
  std::size_t (*count)(const void* value) = nullptr;
  /// Sets that count; new content has its default. A variant is reset even if it already holds that
  /// alternative.
  void (*set_count)(void* value, std::size_t count) = nullptr;
  /// list: entry i; optional: its content; variant: the current alternative.
  void* (*part)(void* value, std::size_t i) = nullptr;

  const void* find_part(const void* value, std::size_t i = 0) const {
    return part(const_cast<void*>(value), i);
  }
  /// Field with that key, or null.
  const Field* field(std::string_view key) const {
    for (const Field& f : fields)
      if (f.key == key) return &f;
    return nullptr;
  }
  /// Field that had that key in earlier versions, or null.
  const Field* former_field(std::string_view key) const {
    for (const Field& f : fields)
      if (!key.empty() && f.info.former_key == key) return &f;
    return nullptr;
  }
};

/// Description of T, built once. T may not contain itself.
template <class T>
const Type& type_of();

namespace detail {

template <class T>
struct Describe {
  static_assert(!std::is_same_v<T, T>,
                "no type for a field: see core/fields/fields.hpp for those allowed");
};

template <TypeKind kind>
struct DescribeScalar {
  static Type type() { return {.kind = kind}; }
};
template <>
struct Describe<bool> : DescribeScalar<TypeKind::boolean> {};
template <>
struct Describe<int> : DescribeScalar<TypeKind::integer> {};
template <>
struct Describe<std::uint64_t> : DescribeScalar<TypeKind::count> {};
template <>
struct Describe<std::uint32_t> : DescribeScalar<TypeKind::index> {};
template <>
struct Describe<double> : DescribeScalar<TypeKind::number> {};
template <>
struct Describe<std::string> : DescribeScalar<TypeKind::text> {};
template <>
struct Describe<Vec2> : DescribeScalar<TypeKind::point> {};

template <NamedEnum E>
struct Describe<E> {
  static constexpr auto names = enum_names(E{});
  static Type type() {
    Type type{.kind = TypeKind::choice};
    for (const auto& [value, word] : names) type.words.push_back(word);
    type.count = [](const void* e) {
      std::size_t i = 0;
      while (i < names.size() && names[i].first != *static_cast<const E*>(e)) ++i;
      assert(i < names.size() && "an enumerator without a word");
      return i;
    };
    type.set_count = [](void* e, std::size_t i) { *static_cast<E*>(e) = names[i].first; };
    return type;
  }
};

template <class Self, class Visitor>
requires HasFields<Self>
void visit_fields(Self& self, Visitor&& visit) { Self::fields(self, visit); }
template <class Visitor>
void visit_fields(const Pose2& pose, Visitor&& visit) {
  visit(pose.position.x, um("x", "Position to the right."));
  visit(pose.position.y, um("y", "Position upwards."));
  visit(pose.heading, deg("heading", "Heading, from x towards y."));
}

template <class T>
requires HasFields<T> || std::is_same_v<T, Pose2>
struct Describe<T> {
  static Type type() {
    static const T defaults{};
    Type type{.kind = TypeKind::record};
    type.defaults = &defaults;
    visit_fields(defaults, [&type]<class F>(const F& field, const FieldInfo& info) {
      const auto offset = reinterpret_cast<const std::byte*>(&field) -
                          reinterpret_cast<const std::byte*>(&defaults);
      assert(!type.field(key_text(info)) && "two fields of one key");
      type.fields.push_back(
          {key_text(info), info, &type_of<F>(), static_cast<std::size_t>(offset)});
    });
    return type;
  }
};

template <class T>
struct Describe<std::optional<T>> {
  static Type type() {
    using Optional = std::optional<T>;
    Type type{.kind = TypeKind::optional};
    type.parts = {&type_of<T>()};
    type.count = [](const void* o) -> std::size_t {
      return static_cast<const Optional*>(o)->has_value() ? 1 : 0;
    };
    type.set_count = [](void* o, std::size_t n) {
      n ? void(static_cast<Optional*>(o)->emplace()) : static_cast<Optional*>(o)->reset();
    };
    type.part = [](void* o, std::size_t) -> void* { return &**static_cast<Optional*>(o); };
    return type;
  }
};

template <class T>
struct Describe<std::vector<T>> {
  static_assert(!std::is_same_v<T, bool>, "std::vector<bool> has no addresses");
  static Type type() {
    using List = std::vector<T>;
    Type type{.kind = TypeKind::list};
    type.parts = {&type_of<T>()};
    type.count = [](const void* list) { return static_cast<const List*>(list)->size(); };
    type.set_count = [](void* list, std::size_t n) { static_cast<List*>(list)->resize(n); };
    type.part = [](void* list, std::size_t i) -> void* { return &(*static_cast<List*>(list))[i]; };
    return type;
  }
};

template <class... Ts>
struct Describe<std::variant<Ts...>> {
  using Variant = std::variant<Ts...>;
  static Type type() {
    Type type{.kind = TypeKind::variant};
    type.words = {Ts::type_name...};
    type.parts = {&type_of<Ts>()...};
    for ([[maybe_unused]] const Type* part : type.parts)
      assert(!part->field("type") && "the key `type` chooses the alternative");
    type.count = [](const void* v) { return static_cast<const Variant*>(v)->index(); };
    type.set_count = [](void* v, std::size_t i) {
      std::size_t at = 0;
      ((at++ == i ? void(static_cast<Variant*>(v)->template emplace<Ts>()) : void()), ...);
    };
    type.part = [](void* v, std::size_t) -> void* {
      return std::visit([](auto& held) -> void* { return &held; }, *static_cast<Variant*>(v));
    };
    return type;
  }
};

}  // namespace detail

/// Defined here; documented above.
template <class T>
const Type& type_of() {
  static const Type type = detail::Describe<T>::type();
  return type;
}

}  // namespace microswarm
