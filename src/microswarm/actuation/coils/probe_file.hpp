// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "microswarm/core/execution/descriptor.hpp"

namespace microswarm::actuation {

/// Rows of a probe's logger: CSV with a header that names bx_mt, by_mt, bz_mt and optionally t_s.
class ProbeRows {
 public:
  /// Throws InputError "NAME: WHY" if a column is missing.
  ProbeRows(std::string_view header, std::string name);

  /// Takes the next bytes of the file and adds the fields [mT] of the rows that they complete. A
  /// row whose time is not after that of the row before is the same reading again and left out.
  /// Throws InputError for a row that cannot be read.
  void take(std::string_view bytes, std::vector<Eigen::Vector3d>& fields);
  /// Forgets the unfinished row; its rest is skipped, too, if it has begun.
  void skip(bool has_begun);

 private:
  void take_row(std::string_view row, std::vector<Eigen::Vector3d>& fields);

  std::string name_;
  std::size_t columns_ = 0;
  char separator_ = ',';
  std::array<std::size_t, 3> field_{};
  std::optional<std::size_t> time_;
  std::optional<double> newest_;  // [s]
  std::string unfinished_;
  bool skipping_ = false;
};

/// A file to which a probe's logger appends rows.
class ProbeFile {
 public:
  /// Throws InputError if the file cannot be read or has no such header.
  explicit ProbeFile(std::filesystem::path path);

  const std::string& name() const { return name_; }
  /// The line that was the last one at the last skip_to_end(), whether or not it is a row.
  const std::string& last_row() const { return last_row_; }
  /// From here on only rows that begin later count.
  void skip_to_end();
  /// Adds the fields [mT] of the rows that are there now. Throws InputError for a row that cannot
  /// be read and for a file that was cut short or replaced.
  void read(std::vector<Eigen::Vector3d>& fields);

 private:
  std::uint64_t size() const;

  std::filesystem::path path_;
  std::string name_;
  Descriptor file_;
  std::uint64_t at_ = 0;
  std::string last_row_;
  std::optional<ProbeRows> rows_;
};

}  // namespace microswarm::actuation
