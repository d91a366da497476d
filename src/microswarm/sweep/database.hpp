// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

struct sqlite3;
struct sqlite3_stmt;

namespace microswarm {

/// What one place in a table holds; std::monostate is NULL. NaN is NULL too once it is stored.
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string>;

/// "name" with quotes around it, as SQL wants a column.
std::string sql_name(std::string_view name);

/// Holds a file for one writer, by a lock on a byte that SQLite does not use. It goes with the
/// process, however that ends.
class WriterLock {
 public:
  /// Makes the file when there is none. Throws InputError "FILE: another sweep is writing to it",
  /// or "FILE: cannot write: REASON".
  explicit WriterLock(const std::filesystem::path& file);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  int file_;
};

/// An SQLite database in a file that exists; an empty file is a database without tables. Every
/// error is an InputError in one line that begins with the file's name.
class Database {
 public:
  enum class Access { read, write };
  Database(const std::filesystem::path& file, Access access);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// One statement, values taking the place of its question marks.
  void run(const std::string& sql, std::span<const SqlValue> values = {}) {
    select(sql, values, {});
  }
  /// The same, with each row of its result.
  void select(const std::string& sql, std::span<const SqlValue> values,
              const std::function<void(std::span<const SqlValue>)>& each) const;
  /// The whole number in the first place of the first row; 0 without a row.
  std::int64_t number(const std::string& sql) const;

  const std::string& name() const { return name_; }
  /// Throws InputError "FILE: WHY".
  [[noreturn]] void fail(const std::string& why) const;

 private:
  [[noreturn]] void fail_with(int code) const;

  std::string name_;
  sqlite3* connection_ = nullptr;
};

/// All statements in its scope come to pass together at `commit()`, or not at all.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace microswarm
