// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "microswarm/sweep/table.hpp"

namespace microswarm::sweep {

/// Host and time of the start of a sweep, for reports and logs.
struct SweepOrigin {
  std::string host{};
  std::string begun{};  ///< "2026-01-31 12:00:00", UTC
};

/// The output database of a sweep: one row per trial, layout in docs/reference/sweep.md. Only one
/// process can hold it open for writing; any number can read.
class SweepDatabase : public SweepStore {
 public:
  /// Creates the database or resumes an existing one. Throws InputError, one line, when another
  /// sweep has it open, when it is not writable, when it is not a sweep database, and when it was
  /// begun with another sweep file, scenario, map or program version.
  SweepDatabase(const std::filesystem::path& file, const SweepPlan& plan,
                const SweepOrigin& origin);

  std::vector<SweepTask> missing() const override;
  /// Adds rows in one transaction; they are on disk when it returns.
  void add(const std::vector<SweepRow>& rows) override;

 private:
  void make(const SweepOrigin& origin);
  void check_same() const;

  const SweepPlan& plan_;
  std::vector<SweepColumn> columns_;
  // Released after the connection: closing any descriptor drops SQLite's own locks.
  WriterLock lock_;
  Database database_;
  std::string insert_;
};

/// Read access to the database of a sweep, also while the sweep runs.
class SweepReader {
 public:
  /// Throws InputError when it is not a sweep database or has an unknown layout.
  explicit SweepReader(const std::filesystem::path& file);

  const std::string& name() const { return database_.name(); }
  const std::vector<SweepColumn>& columns() const { return columns_; }
  /// Index of a column. Throws InputError for an unknown name.
  std::size_t column(const std::string& name) const;
  /// The sweep file.
  const Sweep& sweep() const { return sweep_; }
  std::size_t cells() const;
  std::size_t trials() const;
  /// Metadata of the sweep: version, host, begun, seed, ... Throws InputError for an unknown key.
  std::string about(const std::string& key) const;
  /// The scenario of a cell as YAML, with every key.
  std::string scenario(std::size_t cell) const;

  /// Calls `row` for every row, ordered by cell and trial; with `cell`, only for its rows.
  void each_row(const std::function<void(std::span<const SqlValue>)>& row,
                std::optional<std::size_t> cell = std::nullopt) const;
  /// Calls `value` for every value of one column, in the same order.
  void each_value(std::size_t column, const std::function<void(const SqlValue&)>& value) const;

 private:
  Database database_;
  std::vector<SweepColumn> columns_;
  std::map<std::string, std::string> about_;
  Sweep sweep_;
};

}  // namespace microswarm::sweep
