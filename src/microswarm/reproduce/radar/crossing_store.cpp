// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/radar/crossing_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "microswarm/config/json.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::reproduce {
namespace {

using sweep::SqlValue;

constexpr std::int64_t application_id = 0x6d736372;  // "mscr"
constexpr std::int64_t layout = 1;

/// Fingerprint of the executable, read once.
const std::string& program_hash() {
  static const std::string hash = [] {
    Hash out;
    out.text(read_file("/proc/self/exe"));
    return out.hex();
  }();
  return hash;
}

std::string to_text(const SqlValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text ? *text : std::string();
}

std::vector<SqlValue> columns(const CrossingKey& key) {
  return {std::string(key.course), std::string(key.navigator), static_cast<std::int64_t>(key.seed)};
}

}  // namespace

int Crossing::avoidable() const {
  return static_cast<int>(std::ranges::count_if(contacts, &experiment::ContactVerdict::avoidable));
}

std::string crossing_input(const experiment::Scenario& scenario) {
  Hash hash;
  hash.text(program_hash());
  hash.text(experiment::scenario_text(scenario));
  for (const Obstacle& obstacle : scenario.obstacles) {
    const Track* track = find_track(obstacle.motion);
    if (!track || !track->samples) continue;
    for (const double t : track->samples->times) hash.value(t);
    for (const Vec2 p : track->samples->points) hash.value(p.x), hash.value(p.y);
  }
  return hash.hex();
}

CrossingStore::CrossingStore(const std::filesystem::path& file)
    : lock_(file), database_(file, sweep::Database::Access::write) {
  if (database_.number("PRAGMA application_id") == 0 &&
      database_.number("SELECT count(*) FROM sqlite_master") == 0)
    database_.transaction([&] {
      database_.run(fmt::format("PRAGMA application_id = {}", application_id));
      database_.run(fmt::format("PRAGMA user_version = {}", layout));
      database_.run(
          "CREATE TABLE crossings(course TEXT, navigator TEXT, seed INTEGER, input TEXT, "
          "result TEXT, PRIMARY KEY(course, navigator, seed)) WITHOUT ROWID");
    });
  if (database_.number("PRAGMA application_id") != application_id)
    database_.fail("is no database of crossings");
  if (const auto written = database_.number("PRAGMA user_version"); written != layout)
    database_.fail(fmt::format("has layout {}, this program knows layout {}", written, layout));
  constexpr std::array<std::string_view, 1> tables{"crossings"};
  database_.require_tables(tables);
}

std::optional<Crossing> CrossingStore::find(const CrossingKey& key) {
  const std::lock_guard lock(mutex_);
  std::optional<std::pair<std::string, std::string>> stored;
  database_.select(
      "SELECT input, result FROM crossings WHERE course = ? AND navigator = ? AND seed = ?",
      columns(key),
      [&](std::span<const SqlValue> row) { stored.emplace(to_text(row[0]), to_text(row[1])); });
  if (!stored) return {};
  if (stored->first != key.input) {
    ++outdated_;
    return {};
  }
  Crossing crossing;
  Issues issues;
  read_json(crossing, stored->second, database_.name(), issues);
  if (!issues.empty())
    database_.fail(fmt::format("is damaged: {}, {}, seed {}", key.course, key.navigator, key.seed));
  crossing.ran = true;
  ++found_;
  return crossing;
}

void CrossingStore::add(const CrossingKey& key, const Crossing& crossing) {
  std::vector<SqlValue> values = columns(key);
  values.emplace_back(key.input);
  values.emplace_back(to_json_text(crossing));
  const std::lock_guard lock(mutex_);
  database_.run("INSERT OR REPLACE INTO crossings VALUES(?, ?, ?, ?, ?)", values);
}

}  // namespace microswarm::reproduce
