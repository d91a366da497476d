// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/database.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <system_error>
#include <vector>

#include "microswarm/core/error.hpp"
#include "microswarm/core/text.hpp"

namespace microswarm {
namespace {

constexpr int patience_ms = 60'000;  // for a reader that keeps the file to itself

// SQLite locks bytes from 2^30 on; nobody has a byte here.
constexpr off_t lock_byte = off_t{1} << 62;

std::string reason(int error) { return std::generic_category().message(error); }

using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

int bind(sqlite3_stmt* statement, int place, const SqlValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value))
    return sqlite3_bind_int64(statement, place, *whole);
  if (const auto* real = std::get_if<double>(&value))
    return sqlite3_bind_double(statement, place, *real);
  if (const auto* text = std::get_if<std::string>(&value))
    return sqlite3_bind_text64(statement, place, text->data(), text->size(), SQLITE_STATIC,
                               SQLITE_UTF8);
  return sqlite3_bind_null(statement, place);
}

SqlValue value_at(sqlite3_stmt* statement, int column) {
  switch (sqlite3_column_type(statement, column)) {
    case SQLITE_INTEGER:
      return std::int64_t{sqlite3_column_int64(statement, column)};
    case SQLITE_FLOAT:
      return sqlite3_column_double(statement, column);
    case SQLITE_NULL:
      return std::monostate{};
    default: {
      const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement, column));
      const int size = sqlite3_column_bytes(statement, column);
      return bytes ? std::string(bytes, static_cast<std::size_t>(size)) : std::string();
    }
  }
}

}  // namespace

std::string sql_name(std::string_view name) {
  std::string quoted = "\"";
  for (const char c : name) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + "\"";
}

WriterLock::WriterLock(const std::filesystem::path& file)
    : file_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (file_ < 0)
    throw InputError(fmt::format("{}: cannot write: {}", file.string(), reason(errno)));
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = lock_byte;
  lock.l_len = 1;
  if (::fcntl(file_, F_OFD_SETLK, &lock) == 0) return;
  const int error = errno;
  ::close(file_);
  if (error == EAGAIN || error == EACCES)
    throw InputError(file.string() + ": another sweep is writing to it");
  throw InputError(fmt::format("{}: cannot lock: {}", file.string(), reason(error)));
}

WriterLock::~WriterLock() { ::close(file_); }

Database::Database(const std::filesystem::path& file, Access access) : name_(file.string()) {
  // For reading too: what a writer that was killed left half done is undone by who comes next.
  // SQLite itself is content with reading where it may not write.
  const int code = sqlite3_open_v2(std::filesystem::absolute(file).c_str(), &connection_,
                                   SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  const auto refuse = [&](const std::string& why) {
    sqlite3_close(connection_);
    throw InputError(fmt::format("{}: {}", name_, why));
  };
  if (code != SQLITE_OK) {
    const int error = connection_ ? sqlite3_system_errno(connection_) : 0;
    refuse(fmt::format("cannot {}: {}", access == Access::read ? "read" : "write",
                       error ? reason(error) : sqlite3_errstr(code)));
  }
  if (access == Access::write && sqlite3_db_readonly(connection_, "main") == 1)
    refuse("cannot write: " + reason(EACCES));
  sqlite3_extended_result_codes(connection_, 1);
  sqlite3_busy_timeout(connection_, patience_ms);
}

Database::~Database() { sqlite3_close(connection_); }

void Database::fail(const std::string& why) const {
  throw InputError(fmt::format("{}: {}", name_, why));
}

void Database::fail_with(int code) const {
  const int error = sqlite3_system_errno(connection_);
  const std::string why = one_line(sqlite3_errmsg(connection_));
  switch (code & 0xff) {
    case SQLITE_NOTADB:
      fail("is no SQLite database");
    case SQLITE_CORRUPT:
      fail("is damaged: " + why);
    case SQLITE_BUSY:
      fail(fmt::format("another program has kept it locked for {} s", patience_ms / 1000));
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
      fail("cannot write: " + (error ? reason(error) : why));
    default:
      fail(why);
  }
}

void Database::select(const std::string& sql, std::span<const SqlValue> values,
                      const std::function<void(std::span<const SqlValue>)>& each) const {
  sqlite3_stmt* prepared = nullptr;
  int code = sqlite3_prepare_v2(connection_, sql.c_str(), static_cast<int>(sql.size()), &prepared,
                                nullptr);
  const Statement statement(prepared, sqlite3_finalize);
  for (std::size_t i = 0; code == SQLITE_OK && i < values.size(); ++i)
    code = bind(prepared, static_cast<int>(i + 1), values[i]);
  if (code != SQLITE_OK) fail_with(code);
  std::vector<SqlValue> row(static_cast<std::size_t>(sqlite3_column_count(prepared)));
  while ((code = sqlite3_step(prepared)) == SQLITE_ROW) {
    if (!each) continue;
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = value_at(prepared, static_cast<int>(i));
    each(row);
  }
  if (code != SQLITE_DONE) fail_with(code);
}

std::int64_t Database::number(const std::string& sql) const {
  std::int64_t found = 0;
  bool first = true;
  select(sql, {}, [&](std::span<const SqlValue> row) {
    const auto* whole = std::get_if<std::int64_t>(row.data());
    if (first && whole) found = *whole;
    first = false;
  });
  return found;
}

Transaction::Transaction(Database& database) : database_(database) {
  database_.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const InputError&) {  // the error that led here has been told, or is being told
  }
}

void Transaction::commit() {
  database_.run("COMMIT");
  open_ = false;
}

}  // namespace microswarm
