// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace microswarm::lab {

/// A scenario or record that can be opened.
struct Entry {
  std::string file;  ///< its name in open requests
  std::string name;
  std::string description{};
  bool record = false;
  std::string navigator{};  ///< of a record; empty if unknown
  std::string outcome{};    ///< of a record, "solved"; empty if unknown
  std::string written{};    ///< of a record, local time "2026-11-30 08:15"
  std::string trouble{};    ///< why it cannot be opened, in a line; empty if it can
};

/// The entry of a file; nothing if it is no scenario and no record. A file that is not YAML counts
/// as a scenario if a line of it begins with "map:".
std::optional<Entry> read_entry(const std::filesystem::path& file);

/// Cache of entries by file, each read again after a change of its file. Not thread-safe.
class Entries {
 public:
  const std::optional<Entry>& of(const std::filesystem::path& file);

 private:
  struct Read {
    std::filesystem::file_time_type written;
    std::optional<Entry> entry;
  };
  std::map<std::filesystem::path, Read> read_;
};

}  // namespace microswarm::lab
