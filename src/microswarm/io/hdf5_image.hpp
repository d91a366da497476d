// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm {

/// HDF5 file built in memory from plain one-dimensional datasets, which every HDF5 reader accepts.
/// The same calls give the same bytes. Groups are created with their contents. Several
/// threads may use writers and readers of their own; HDF5 works for one of them at a time.
class Hdf5Writer {
 public:
  Hdf5Writer();
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void dataset(const std::string& path, std::span<const double> values);
  void dataset(const std::string& path, std::span<const float> values);
  void dataset(const std::string& path, std::span<const std::int64_t> values);
  /// Texts in UTF-8, all stored with the length of the longest.
  void dataset(const std::string& path, std::span<const std::string> values);
  /// One text of fixed length, UTF-8.
  void text(const std::string& path, std::string_view value);

  /// Attribute of an existing dataset or group; "/" is the root.
  void attribute(const std::string& path, const char* name, std::string_view value);
  void attribute(const std::string& path, const char* name, double value);
  void attribute(const std::string& path, const char* name, std::int64_t value);
  void attribute(const std::string& path, const char* name, std::uint64_t value);
  void group(const std::string& path);

  /// Closes the writer and returns the file's bytes.
  std::string finish();

 private:
  std::int64_t file_;
};

/// Reads files of Hdf5Writer from untrusted bytes. Throws InputError "NAME: WHY" if something is
/// missing, has another shape, is too large or is in another file: external and virtual datasets
/// and external links are refused. A column needs the storage of its values, and no two share it,
/// so that what is read is at most 1032 times the file, what deflate can pack.
class Hdf5Reader {
 public:
  Hdf5Reader(std::string bytes, std::string name);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// Number of values of a column, which are not read.
  std::size_t length(const std::string& path) const;
  std::vector<double> numbers(const std::string& path) const;
  std::vector<std::int64_t> integers(const std::string& path) const;
  std::string text(const std::string& path) const;

  bool has_attribute(const std::string& path, const char* name) const;
  std::string text_attribute(const std::string& path, const char* name) const;
  double number_attribute(const std::string& path, const char* name) const;
  std::int64_t integer_attribute(const std::string& path, const char* name) const;

  const std::string& name() const { return name_; }
  /// Throws InputError "NAME: WHY".
  [[noreturn]] void fail(const std::string& why) const;
  /// Counts the stored bytes of a dataset once. Throws if all of them are more than the file.
  void claim(const std::string& path, std::uint64_t stored) const;

 private:
  std::string bytes_;
  std::string name_;
  std::int64_t file_;
  std::uint64_t file_bytes_ = 0;
  mutable std::set<std::string> claimed_;
  mutable std::uint64_t claimed_bytes_ = 0;
};

}  // namespace microswarm
