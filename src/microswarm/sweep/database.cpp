// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/database.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::sweep {
namespace {

constexpr int busy_timeout_ms = 60'000;  // for a reader that locks the file

// SQLite locks bytes from 2^30 on; no file has a byte here.
constexpr off_t lock_byte = off_t{1} << 62;

constexpr int max_value_bytes = 16 << 20;   // of a value or a row
constexpr int steps_at_a_time = 1'000'000;  // of SQLite's machine
constexpr int max_steps_a_row = 200;        // times the above: a second or more

std::string reason(int error) { return std::generic_category().message(error); }

void bind(SQLite::Statement& statement, int index, const SqlValue& value) {
  std::visit(Overloaded{[&](std::monostate) { statement.bind(index); },
                        [&](const OneOf<std::int64_t, double> auto& number) {
                          statement.bind(index, number);
                        },
                        [&](const std::string& text) { statement.bindNoCopy(index, text); }},
             value);
}

SqlValue to_value(const SQLite::Column& column) {
  if (column.isInteger()) return std::int64_t{column.getInt64()};
  if (column.isFloat()) return column.getDouble();
  if (column.isNull()) return std::monostate{};
  return column.getString();
}

/// Disables everything in the file that could act by itself: views, triggers, functions with side
/// effects, changes of the schema other than by statements; long values are refused.
void harden(sqlite3* database) {
  for (const auto& [option, on] :
       {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1}, std::pair{SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
        std::pair{SQLITE_DBCONFIG_ENABLE_VIEW, 0}, std::pair{SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
        std::pair{SQLITE_DBCONFIG_DQS_DDL, 0}, std::pair{SQLITE_DBCONFIG_DQS_DML, 0}})
    sqlite3_db_config(database, option, on, nullptr);
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, max_value_bytes);
  sqlite3_limit(database, SQLITE_LIMIT_ATTACHED, 0);
}

/// Aborts a statement that takes too many steps without a row.
int count_steps(void* steps) { return ++*static_cast<int*>(steps) > max_steps_a_row; }

}  // namespace

std::string sql_name(std::string_view name) {
  std::string quoted = "\"";
  for (const char c : name) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + "\"";
}

WriterLock::WriterLock(const std::filesystem::path& file)
    : file_(open_descriptor(file, O_RDWR | O_CREAT)) {
  if (!file_) throw InputError(file.string(), fmt::format("cannot write: {}", reason(errno)));
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = lock_byte;
  lock.l_len = 1;
  if (::fcntl(file_.get(), F_OFD_SETLK, &lock) == 0) return;
  const int error = errno;
  if (error == EAGAIN || error == EACCES)
    throw InputError(file.string(), "another process is writing to it");
  throw InputError(file.string(), fmt::format("cannot lock: {}", reason(error)));
}

// Opened for writing even to read, which rolls back what a killed writer left half done; where the
// file may not be written SQLite is content with reading.
Database::Database(const std::filesystem::path& file, Access access) : name_(file.string()) {
  const bool write = access == Access::write;
  errno = 0;
  if (::access(file.c_str(), write ? W_OK : R_OK) != 0)
    fail(fmt::format("cannot {}: {}", write ? "write" : "read", reason(errno)));
  try {
    connection_ = std::make_unique<SQLite::Database>(std::filesystem::absolute(file).string(),
                                                     SQLite::OPEN_READWRITE | SQLite::OPEN_NOMUTEX,
                                                     busy_timeout_ms);
    harden(connection_->getHandle());
    sqlite3_progress_handler(connection_->getHandle(), steps_at_a_time, count_steps, &steps_);
  } catch (const SQLite::Exception& error) {
    fail(fmt::format("cannot {}: {}", write ? "write" : "read", error.getErrorStr()));
  }
}

Database::~Database() = default;

void Database::fail(const std::string& why) const { throw InputError(name_, why); }

void Database::fail(const SQLite::Exception& error) const {
  const int system = sqlite3_system_errno(connection_->getHandle());
  const std::string why = one_line(error.what());
  switch (error.getErrorCode() & 0xff) {
    case SQLITE_NOTADB:
      fail("is no SQLite database");
    case SQLITE_CORRUPT:
      fail("is damaged: " + why);
    case SQLITE_BUSY:
      fail(fmt::format("another program has kept it locked for {} s", busy_timeout_ms / 1000));
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
      fail("cannot write: " + (system ? reason(system) : why));
    case SQLITE_INTERRUPT:
      fail("a statement does not come to an end");
    case SQLITE_TOOBIG:
      fail(fmt::format("holds a value of more than {} bytes", max_value_bytes));
    default:
      fail(why);
  }
}

void Database::require_tables(std::span<const std::string_view> tables) const {
  for (const std::string_view table : tables) {
    bool found = false;
    const std::vector<SqlValue> name{std::string(table)};
    select("SELECT 1 FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name = ?", name,
           [&](std::span<const SqlValue>) { found = true; });
    if (!found) fail(fmt::format("is damaged: {} is no table", table));
  }
}

void Database::select(const std::string& sql, std::span<const SqlValue> values,
                      const std::function<void(std::span<const SqlValue>)>& each) const try {
  steps_ = 0;
  SQLite::Statement statement(*connection_, sql);
  for (std::size_t i = 0; i < values.size(); ++i)
    bind(statement, static_cast<int>(i + 1), values[i]);
  std::vector<SqlValue> row(static_cast<std::size_t>(statement.getColumnCount()));
  while (statement.executeStep()) {
    steps_ = 0;
    if (!each) continue;
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = to_value(statement.getColumn(static_cast<int>(i)));
    each(row);
  }
} catch (const SQLite::Exception& error) {
  fail(error);
}

void Database::run_each(const std::string& sql, std::size_t count,
                        const std::function<std::span<const SqlValue>(std::size_t)>& values) try {
  SQLite::Statement statement(*connection_, sql);
  for (std::size_t i = 0; i < count; ++i) {
    steps_ = 0;
    const std::span<const SqlValue> row = values(i);
    for (std::size_t k = 0; k < row.size(); ++k) bind(statement, static_cast<int>(k + 1), row[k]);
    statement.exec();
    statement.reset();
  }
} catch (const SQLite::Exception& error) {
  fail(error);
}

std::int64_t Database::number(const std::string& sql) const try {
  steps_ = 0;
  SQLite::Statement statement(*connection_, sql);
  return statement.executeStep() ? statement.getColumn(0).getInt64() : 0;
} catch (const SQLite::Exception& error) {
  fail(error);
}

void Database::transaction(const std::function<void()>& statements) try {
  steps_ = 0;
  SQLite::Transaction whole(*connection_, SQLite::TransactionBehavior::IMMEDIATE);
  statements();
  steps_ = 0;
  whole.commit();
} catch (const SQLite::Exception& error) {
  fail(error);
}

}  // namespace microswarm::sweep
