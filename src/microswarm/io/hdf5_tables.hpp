// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/config/type.hpp"
#include "microswarm/io/hdf5_image.hpp"

namespace microswarm {

/// Writes the tables of a described value, see visit_tables: a group a table, a dataset a column,
/// with the attributes `unit` and `description`. Words are integers that count into the attribute
/// `words`. The rows of parts follow each other; `offset` says which belong to which row.
void write_tables(Hdf5Writer& out, const Type& type, const void* value);

/// Reads them back. Throws InputError for what does not fit the description.
void read_tables(const Hdf5Reader& in, const Type& type, void* value);

/// Writes the numbers of a described value, and of what is nested in it, as attributes of a group.
void write_attributes(Hdf5Writer& out, const std::string& group, const Type& type,
                      const void* value);

/// Reads them back; errors as above.
void read_attributes(const Hdf5Reader& in, const std::string& group, const Type& type, void* value);

}  // namespace microswarm
