// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/sweep_database.hpp"

#include <fmt/format.h>

#include <array>

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/core/version.hpp"

namespace microswarm::sweep {
namespace {

constexpr std::int64_t application_id = 0x6d737770;  // "mswp"
constexpr std::int64_t layout = 1;

std::string to_text(const SqlValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text ? *text : std::string();
}

bool is_empty(const Database& database) {
  return database.number("PRAGMA application_id") == 0 &&
         database.number("SELECT count(*) FROM sqlite_master") == 0;
}

void check_layout(const Database& database) {
  if (database.number("PRAGMA application_id") != application_id)
    database.fail("is no database of a sweep");
  const std::int64_t written = database.number("PRAGMA user_version");
  if (written != layout)
    database.fail(
        fmt::format("has sweep layout {}, this program knows layout {}", written, layout));
  constexpr std::array<std::string_view, 4> tables{"sweep", "columns", "cells", "trials"};
  database.require_tables(tables);
}

std::map<std::string, std::string> read_about(const Database& database) {
  std::map<std::string, std::string> about;
  database.select("SELECT key, value FROM sweep", {},
                  [&](std::span<const SqlValue> row) { about[to_text(row[0])] = to_text(row[1]); });
  return about;
}

std::vector<SweepColumn> read_columns(const Database& database) {
  std::vector<SweepColumn> columns;
  database.select(
      "SELECT name, kind, unit, description, role FROM columns ORDER BY place", {},
      [&](std::span<const SqlValue> row) {
        const auto kind = enum_value<SweepColumnKind>(to_text(row[1]));
        const auto role = enum_value<SweepColumn::Role>(to_text(row[4]));
        if (!kind || !role) database.fail("is damaged: an unknown kind of column");
        columns.push_back({to_text(row[0]), *kind, to_text(row[2]), to_text(row[3]), *role});
      });
  return columns;
}

/// `WITHOUT ROWID` keeps the rows in the order of their key, independent of insertion.
std::string trials_sql(const std::vector<SweepColumn>& columns) {
  std::string sql = "CREATE TABLE trials(";
  for (const SweepColumn& column : columns)
    sql += fmt::format("{} {}, ", sql_name(column.name), enum_name(column.kind));
  return sql + "PRIMARY KEY(cell, trial)) WITHOUT ROWID";
}

std::string insert_sql(const std::vector<SweepColumn>& columns) {
  std::string placeholders;
  for (std::size_t i = 0; i < columns.size(); ++i) placeholders += i ? ", ?" : "?";
  return fmt::format("INSERT INTO trials VALUES({})", placeholders);
}

std::string inputs_hash(const SweepPlan& plan) {
  Hash hash;
  for (const SweepCell& cell : plan.cells) hash.text(cell.input_hash);
  return hash.hex();
}

/// An input that must not change during a sweep: its name for messages, and its text or hash.
struct Identity {
  const char* key;
  const char* name;
  std::string value;
};

std::vector<Identity> plan_identity(const SweepPlan& plan) {
  return {{"version", "version of this program", std::string(version)},
          {"sweep", "sweep file", to_yaml(plan.sweep)},
          {"scenario", "scenario", plan.scenario_text},
          {"inputs_hash", "map, track or program", inputs_hash(plan)}};
}

/// Throws for a folder, so that its message differs from that of an unwritable file.
const std::filesystem::path& no_folder(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw InputError(file.string(), "is a folder, must be a file for the database");
  return file;
}

}  // namespace

SweepDatabase::SweepDatabase(const std::filesystem::path& file, const SweepPlan& plan,
                             const SweepOrigin& origin)
    : plan_(plan),
      columns_(sweep_columns(plan)),
      lock_(no_folder(file)),
      database_(file, Database::Access::write),
      insert_(insert_sql(columns_)) {
  if (is_empty(database_)) {
    try {
      database_.transaction([&] { make(origin); });
    } catch (const InputError&) {  // removes a file that was not completed
      std::error_code error;
      if (std::filesystem::file_size(file, error) == 0) std::filesystem::remove(file, error);
      throw;
    }
  } else {
    check_layout(database_);
    check_same();
  }
}

void SweepDatabase::make(const SweepOrigin& origin) {
  database_.run(fmt::format("PRAGMA application_id = {}", application_id));
  database_.run(fmt::format("PRAGMA user_version = {}", layout));
  database_.run("CREATE TABLE sweep(key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID");
  const auto about = [&](const std::string& key, const std::string& value) {
    database_.run("INSERT INTO sweep VALUES(?, ?)", std::vector<SqlValue>{key, value});
  };
  for (const Identity& one : plan_identity(plan_)) about(one.key, one.value);
  about("name", plan_.sweep.name);
  about("hash", plan_.hash());
  about("trials", std::to_string(plan_.sweep.trials));
  about("seed", std::to_string(plan_.cells.front().scenario.seed));
  about("host", origin.host);
  about("begun", origin.begun);

  database_.run(
      "CREATE TABLE columns(place INTEGER PRIMARY KEY, name TEXT, kind TEXT, unit TEXT, "
      "description TEXT, role TEXT)");
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const SweepColumn& column = columns_[i];
    database_.run("INSERT INTO columns VALUES(?, ?, ?, ?, ?, ?)",
                  std::vector<SqlValue>{static_cast<std::int64_t>(i), column.name,
                                        std::string(enum_name(column.kind)), column.unit,
                                        column.description, std::string(enum_name(column.role))});
  }
  database_.run(
      "CREATE TABLE cells(cell INTEGER PRIMARY KEY, method TEXT, input_hash TEXT, scenario TEXT)");
  for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
    const SweepCell& cell = plan_.cells[i];
    database_.run("INSERT INTO cells VALUES(?, ?, ?, ?)",
                  std::vector<SqlValue>{static_cast<std::int64_t>(i), cell.method, cell.input_hash,
                                        experiment::scenario_text(cell.scenario)});
  }
  database_.run(trials_sql(columns_));
}

void SweepDatabase::check_same() const {
  auto about = read_about(database_);
  for (const Identity& one : plan_identity(plan_))
    if (about[one.key] != one.value)
      database_.fail(
          fmt::format("was begun with another {}: go on with that one, or give another {}",
                      one.name, input_name("database")));
  const std::vector<SweepColumn> columns = read_columns(database_);
  bool same = columns.size() == columns_.size();
  for (std::size_t i = 0; same && i < columns.size(); ++i)
    same = columns[i].name == columns_[i].name && columns[i].kind == columns_[i].kind;
  if (!same)
    database_.fail("was begun by a program with other columns: give another " +
                   input_name("database"));
}

std::vector<SweepTask> SweepDatabase::missing() const {
  const auto trials = static_cast<std::uint32_t>(plan_.sweep.trials);
  std::vector<bool> there(plan_.cells.size() * trials);
  database_.select("SELECT cell, trial FROM trials", {}, [&](std::span<const SqlValue> row) {
    const auto* cell = std::get_if<std::int64_t>(row.data());
    const auto* trial = std::get_if<std::int64_t>(&row[1]);
    if (!cell || !trial || *cell < 0 || *trial < 0 || *trial >= trials ||
        static_cast<std::size_t>(*cell) >= plan_.cells.size())
      database_.fail("is damaged: it has a trial that the sweep has not");
    there[static_cast<std::size_t>(*cell) * trials + static_cast<std::size_t>(*trial)] = true;
  });
  std::vector<SweepTask> tasks;
  for (std::uint32_t cell = 0; cell < plan_.cells.size(); ++cell)
    for (std::uint32_t trial = 0; trial < trials; ++trial)
      if (!there[std::size_t{cell} * trials + trial]) tasks.push_back({cell, trial});
  return tasks;
}

void SweepDatabase::add(const std::vector<SweepRow>& rows) {
  if (rows.empty()) return;
  std::vector<SqlValue> values;
  database_.transaction([&] {
    database_.run_each(insert_, rows.size(), [&](std::size_t i) -> std::span<const SqlValue> {
      values = task_values(plan_, columns_, rows[i].task);
      values.insert(values.end(), rows[i].values.begin(), rows[i].values.end());
      return values;
    });
  });
}

SweepReader::SweepReader(const std::filesystem::path& file)
    : database_(no_folder(file), Database::Access::read) {
  check_layout(database_);
  columns_ = read_columns(database_);
  about_ = read_about(database_);
  sweep_ = read_sweep_text(about("sweep"), name() + ", sweep");
}

std::size_t SweepReader::column(const std::string& name) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].name == name) return i;
  database_.fail("is damaged: it has no column " + quote(name));
}

std::string SweepReader::about(const std::string& key) const {
  const auto found = about_.find(key);
  if (found == about_.end()) database_.fail("is damaged: it does not say its " + key);
  return found->second;
}

std::size_t SweepReader::cells() const {
  return static_cast<std::size_t>(database_.number("SELECT count(*) FROM cells"));
}

std::size_t SweepReader::trials() const {
  return static_cast<std::size_t>(database_.number("SELECT count(*) FROM trials"));
}

std::string SweepReader::scenario(std::size_t cell) const {
  std::string text;
  database_.select("SELECT scenario FROM cells WHERE cell = ?",
                   std::vector<SqlValue>{static_cast<std::int64_t>(cell)},
                   [&](std::span<const SqlValue> row) { text = to_text(row[0]); });
  return text;
}

void SweepReader::each_row(const std::function<void(std::span<const SqlValue>)>& row,
                           std::optional<std::size_t> cell) const {
  std::string names;
  for (const SweepColumn& column : columns_)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", sql_name(column.name));
  std::vector<SqlValue> values;
  if (cell) values.emplace_back(static_cast<std::int64_t>(*cell));
  database_.select(fmt::format("SELECT {} FROM trials{} ORDER BY cell, trial", names,
                               cell ? " WHERE cell = ?" : ""),
                   values, row);
}

void SweepReader::each_value(std::size_t column,
                             const std::function<void(const SqlValue&)>& value) const {
  database_.select(
      fmt::format("SELECT {} FROM trials ORDER BY cell, trial", sql_name(columns_[column].name)),
      {}, [&](std::span<const SqlValue> row) { value(row[0]); });
}

}  // namespace microswarm::sweep
