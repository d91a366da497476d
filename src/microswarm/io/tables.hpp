// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "microswarm/config/type.hpp"
#include "microswarm/io/columns.hpp"

namespace microswarm::io {

/// Reference to a described list. `Pointer` is void* or const void*.
template <class Pointer>
struct ListRef {
  const Type* type;  ///< of the list
  Pointer value{};

  const Type& row_type() const { return *type->parts[0]; }
  std::size_t size() const { return type->count(value); }
  Pointer row(std::size_t i) const { return type->part(const_cast<void*>(value_at()), i); }
  void resize(std::size_t size) const { type->set_count(value, size); }
  /// List held in a field of row i.
  ListRef part(std::size_t i, const Field& field) const { return {field.type, field.in(row(i))}; }

 private:
  const void* value_at() const { return value; }
};

/// Visits one of the tables of a described value, which the field holds; see visit_tables.
template <class Pointer, class Visitor>
void visit_table(const Field& field, Pointer value, Visitor&& visit, std::string_view parent) {
  const ListRef<Pointer> list{field.type, field.in(value)};
  const std::string group = std::string(parent) + "/" + std::string(field.info.name);
  visit.table(group, list);
  for (const Field& inner : list.row_type().fields)
    if (inner.type->kind == TypeKind::list)
      visit.parts(group + "/" + std::string(inner.info.name), list, inner);
}

/// Visits the tables of a described value. A table is a list of rows; lists inside the rows form
/// tables of parts:
///
///     visit.table(group, list)            // "/plans"
///     visit.parts(group, list, field)     // "/plans/tree"
///
/// field.in(row) is the list in a row of the parent table. `parent` stands before the groups.
template <class Pointer, class Visitor>
void visit_tables(const Type& type, Pointer value, Visitor&& visit, std::string_view parent = {}) {
  for (const Field& field : type.fields)
    if (field.type->kind == TypeKind::list) visit_table(field, value, visit, parent);
}

}  // namespace microswarm::io
