// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "microswarm/config/type.hpp"
#include "microswarm/io/hdf5_image.hpp"

namespace microswarm::io {

/// Writes the tables of a described value (see visit_tables): one group per table and one dataset
/// per column, with the attributes `unit` and `description`. An integer without a value is -1.
/// Words are stored as indices into the attribute `words`. Rows of parts are concatenated; `offset`
/// gives the range that belongs to each row.
void write_tables(Hdf5Writer& out, const Type& type, const void* value);

/// Reads the tables back. Throws InputError if they do not match the description.
void read_tables(const Hdf5Reader& in, const Type& type, void* value);

/// Writes or reads only the table that a field of the described value holds, in the group `parent`.
/// Columns may be absent, except the first, as in files of former versions: then rows have the
/// values of their type.
void write_table(Hdf5Writer& out, const Field& field, const void* value, std::string_view parent);
void read_table(const Hdf5Reader& in, const Field& field, void* value, std::string_view parent);

/// Writes the numbers of a described value, including nested ones, as attributes of a group.
void write_attributes(Hdf5Writer& out, const std::string& group, const Type& type,
                      const void* value);

/// Reads the attributes back; errors as above.
void read_attributes(const Hdf5Reader& in, const std::string& group, const Type& type, void* value);

}  // namespace microswarm::io
