// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "microswarm/core/execution/descriptor.hpp"

namespace SQLite {  // NOLINT(readability-identifier-naming): the name is theirs
class Database;
class Exception;
}  // namespace SQLite

namespace microswarm::sweep {

/// A value in a table; std::monostate is NULL. A stored NaN becomes NULL.
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string>;

/// `name` as a quoted SQL identifier.
std::string sql_name(std::string_view name);

/// Exclusive lock of a file for one writer, on a byte that SQLite does not use. The kernel releases
/// it when the process ends.
class WriterLock {
 public:
  /// Creates the file if necessary. Throws InputError "FILE: another process is writing to it",
  /// or "FILE: cannot write: REASON".
  explicit WriterLock(const std::filesystem::path& file);

 private:
  Descriptor file_;
};

/// An SQLite database in a file that exists; an empty file is a database without tables. The file
/// is not trusted: views and triggers are disabled, values above 16 MiB are refused, and a
/// statement that runs long without a row is aborted. Every error is an InputError of one line that
/// begins with the file's name.
class Database {
 public:
  enum class Access { read, write };
  Database(const std::filesystem::path& file, Access access);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Executes one statement; `values` are bound to its question marks.
  void run(const std::string& sql, std::span<const SqlValue> values = {}) {
    select(sql, values, {});
  }
  /// The same, and calls `each` for every row of the result.
  void select(const std::string& sql, std::span<const SqlValue> values,
              const std::function<void(std::span<const SqlValue>)>& each) const;
  /// Executes one statement `count` times, prepared once, with the values of each index. Within a
  /// transaction this is much faster than `run`.
  void run_each(const std::string& sql, std::size_t count,
                const std::function<std::span<const SqlValue>(std::size_t)>& values);
  /// Integer in the first column of the first row; 0 without a row.
  std::int64_t number(const std::string& sql) const;
  /// Executes `statements` in one transaction, which is rolled back if they throw.
  void transaction(const std::function<void()>& statements);

  /// Throws InputError if one of these is missing or no ordinary table, such as a view or a virtual
  /// table.
  void require_tables(std::span<const std::string_view> tables) const;

  const std::string& name() const { return name_; }
  /// Throws InputError "FILE: WHY".
  [[noreturn]] void fail(const std::string& why) const;

 private:
  [[noreturn]] void fail(const SQLite::Exception& error) const;

  std::string name_;
  mutable int steps_ = 0;  ///< steps since the last row
  std::unique_ptr<SQLite::Database> connection_;
};

}  // namespace microswarm::sweep
