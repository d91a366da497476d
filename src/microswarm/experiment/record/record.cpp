// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/record.hpp"

#include "microswarm/core/maths/hash.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/io/tables.hpp"

namespace microswarm::experiment {

namespace {

/// Hashes numbers in their stored types, so equal hashes mean bit-identical records.
struct TableHasher {
  Hash& hash;

  void table(const std::string&, const io::ListRef<const void*>& list) const {
    rows(list, io::to_columns(list.row_type()));
  }
  void parts(const std::string&, const io::ListRef<const void*>& outer, const Field& field) const {
    const auto columns = io::to_columns(*field.type->parts[0]);
    for (std::size_t i = 0; i < outer.size(); ++i) rows(outer.part(i, field), columns);
  }
  void rows(const io::ListRef<const void*>& list, const std::vector<io::Column>& columns) const {
    hash.value(static_cast<std::uint64_t>(list.size()));
    for (const io::Column& column : columns)
      for (std::size_t i = 0; i < list.size(); ++i)
        column.kind == io::ColumnKind::word ? hash.text(column.word(list.row(i)))
                                            : hash.value(column.number(list.row(i)));
  }
};

/// Hashes integers as integers.
void hash_metrics(Hash& hash, const Metrics& metrics) {
  for (const io::Column& column : io::to_columns<Metrics>()) {
    const double value = column.number(&metrics);
    column.kind == io::ColumnKind::real ? hash.value(value) : hash.value(static_cast<int>(value));
  }
}

}  // namespace

std::string Record::hash() const {
  Hash hash;
  hash.text(to_string(result.status));
  hash_metrics(hash, result.metrics);
  io::visit_tables(type_of<Record>(), static_cast<const void*>(this), TableHasher{hash});
  for (const Change& change : changes) hash.value(change.frame), hash.text(change.setting);
  return hash.hex();
}

}  // namespace microswarm::experiment

namespace microswarm {

template const Type& type_of<experiment::Record>();

}  // namespace microswarm
