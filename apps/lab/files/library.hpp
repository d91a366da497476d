// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lab/files/entry.hpp"
#include "microswarm/config/settings.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::lab {

/// Names of the files that a scenario reads: map, tracks, model; relative to its own folder.
std::vector<std::string*> referenced_files(experiment::Scenario& scenario);

/// The folders whose files the lab lists and opens. Other files are not accessible.
class Library {
 public:
  explicit Library(const std::vector<std::filesystem::path>& folders);

  /// The scenarios (.yaml with a map, also those with mistakes) and records (.h5), sorted by name
  /// of file. Not thread-safe.
  std::vector<Entry> entries() const;
  /// Path of the file of that name. Throws InputError if it is outside of the folders, links
  /// resolved.
  std::filesystem::path find(std::string_view file) const;
  /// Throws InputError if a scenario with `settings` names a file outside of the folders (map,
  /// track, model), unless it does so with the `trusted` settings. A record names no files.
  void check(const std::filesystem::path& scenario, const Settings& settings,
             const Settings& trusted = {}) const;

  /// Throws InputError if the scenario names a file outside of the folders.
  void check_all(const std::filesystem::path& scenario) const;

 private:
  std::vector<std::filesystem::path> folders_;
  mutable Entries entries_;  ///< used by entries() only
};

}  // namespace microswarm::lab
