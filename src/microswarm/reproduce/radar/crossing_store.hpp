// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "microswarm/reproduce/radar/crossing.hpp"
#include "microswarm/sweep/database.hpp"

namespace microswarm::reproduce {

/// Key of a crossing: the run that it is the result of.
struct CrossingKey {
  std::string_view course{};
  std::string_view navigator{};
  std::uint64_t seed = 0;
  std::string input{};  ///< `crossing_input` of the scenario
};

/// Fingerprint of a scenario with its navigator and the samples of its tracks, and of the bytes of
/// this program: another build may decide otherwise.
std::string crossing_input(const experiment::Scenario& scenario);

/// The crossings of a campaign in a SQLite database, so that an interrupted campaign can be
/// resumed. Safe for use by several threads, and open in one process at a time.
class CrossingStore {
 public:
  /// Opens or creates the database. Throws InputError, one line, when it is not writable, is open
  /// in another process or is another kind of database.
  explicit CrossingStore(const std::filesystem::path& file);

  /// The stored crossing; empty if there is none with the same input. Throws InputError when it is
  /// damaged.
  std::optional<Crossing> find(const CrossingKey& key);
  /// Stores a crossing in place of one with another input. It is on disk when this returns.
  void add(const CrossingKey& key, const Crossing& crossing);

  const std::string& name() const { return database_.name(); }
  int found() const { return found_; }        ///< crossings that `find` has returned
  int outdated() const { return outdated_; }  ///< crossings that it refused for their input

 private:
  std::mutex mutex_;
  // Released after the connection: closing any descriptor drops SQLite's own locks.
  sweep::WriterLock lock_;
  sweep::Database database_;
  int found_ = 0;
  int outdated_ = 0;
};

}  // namespace microswarm::reproduce
