// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "microswarm/sweep/table.hpp"

namespace microswarm {

/// Where and when a sweep was begun: for people, and for logs that want it.
struct SweepOrigin {
  std::string host;
  std::string begun;  ///< "2026-01-31 12:00:00", UTC
};

/// The database that a sweep writes: one row a trial, layout in docs/reference/sweep.md. While it
/// is open no other process can open it so; anybody may read.
class SweepDatabase {
 public:
  /// Makes the database, or takes it where it was left. Throws InputError, one line: when another
  /// sweep has it, when it cannot be written, when it is something else, and when it was begun with
  /// another sweep file, scenario or map or by another version of the program.
  SweepDatabase(const std::filesystem::path& file, const SweepPlan& plan,
                const SweepOrigin& origin);

  /// Trials that have no row yet, cell by cell.
  std::vector<SweepTask> missing() const;
  /// Adds rows in one transaction; when it returns they are on the disk.
  void add(const std::vector<SweepRow>& rows);

 private:
  void make(const SweepOrigin& origin);
  void check_same() const;

  const SweepPlan& plan_;
  std::vector<SweepColumn> columns_;
  WriterLock lock_;  // let go after the connection: closing any descriptor ends SQLite's own locks
  Database database_;
  std::string insert_;
};

/// What the database of a sweep says, of a sweep that goes on too.
class SweepReader {
 public:
  /// Throws InputError when it is no database of a sweep, or of a layout that this program does not
  /// read.
  explicit SweepReader(const std::filesystem::path& file);

  const std::string& name() const { return database_.name(); }
  const std::vector<SweepColumn>& columns() const { return columns_; }
  /// Index of a column. Throws InputError when there is none of that name.
  std::size_t column(const std::string& name) const;
  /// The sweep file as YAML, with every key written out.
  const Sweep& sweep() const { return sweep_; }
  std::size_t cells() const;
  std::size_t trials() const;
  /// A text kept about the sweep: version, host, begun, seed, ... Throws InputError for none.
  std::string about(const std::string& key) const;
  /// The scenario of a cell as YAML, with every key written out.
  std::string scenario(std::size_t cell) const;

  /// Every row in the order of cells and trials; with `cell` only those of one.
  void each_row(const std::function<void(std::span<const SqlValue>)>& row,
                std::optional<std::size_t> cell = std::nullopt) const;
  /// The values of one column, in the same order.
  void each_value(std::size_t column, const std::function<void(const SqlValue&)>& value) const;

 private:
  Database database_;
  std::vector<SweepColumn> columns_;
  std::map<std::string, std::string> about_;
  Sweep sweep_;
};

}  // namespace microswarm
