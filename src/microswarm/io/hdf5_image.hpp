// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::io {

// HDF5 brings some 30 shared libraries for files in the network, a quarter of a program's start, so
// it is in a module that is loaded at the first use.

/// HDF5 file built in memory from plain one-dimensional datasets, which every HDF5 reader accepts.
/// The same calls give the same bytes. Groups are created with their contents. Several
/// threads may each use their writers and readers; HDF5 serves one of them at a time.
class Hdf5Writer {
 public:
  virtual ~Hdf5Writer() = default;

  virtual void dataset(const std::string& path, std::span<const double> values) = 0;
  virtual void dataset(const std::string& path, std::span<const float> values) = 0;
  virtual void dataset(const std::string& path, std::span<const std::int64_t> values) = 0;
  /// Texts in UTF-8, or ASCII if they are that, all stored with the length of the longest.
  virtual void dataset(const std::string& path, std::span<const std::string> values) = 0;
  /// One text of fixed length, ASCII or UTF-8.
  virtual void text(const std::string& path, std::string_view value) = 0;

  /// Attribute of an existing dataset or group; "/" is the root.
  virtual void attribute(const std::string& path, const char* name, std::string_view value) = 0;
  virtual void attribute(const std::string& path, const char* name, double value) = 0;
  virtual void attribute(const std::string& path, const char* name, std::int64_t value) = 0;
  virtual void attribute(const std::string& path, const char* name, std::uint64_t value) = 0;
  virtual void group(const std::string& path) = 0;

  /// Closes the writer and returns the file's bytes.
  virtual std::string finish() = 0;
};

/// Reads files of Hdf5Writer from untrusted bytes. Throws InputError "NAME: WHY" if something is
/// missing, has another shape, is too large or is in another file: external and virtual datasets
/// and external links are refused. A column needs the storage of its values, and no two share it,
/// so that what is read is at most 1032 times the file, what deflate can pack.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::string name) : name_(std::move(name)) {}
  virtual ~Hdf5Reader() = default;

  /// Number of values of a column, which are not read.
  virtual std::size_t length(const std::string& path) const = 0;
  virtual std::vector<double> numbers(const std::string& path) const = 0;
  virtual std::vector<std::int64_t> integers(const std::string& path) const = 0;
  virtual std::string text(const std::string& path) const = 0;

  virtual bool has_attribute(const std::string& path, const char* name) const = 0;
  virtual std::string text_attribute(const std::string& path, const char* name) const = 0;
  virtual double number_attribute(const std::string& path, const char* name) const = 0;
  virtual std::int64_t integer_attribute(const std::string& path, const char* name) const = 0;

  const std::string& name() const { return name_; }
  /// Throws InputError "NAME: WHY".
  [[noreturn]] void fail(const std::string& why) const { throw InputError(name_, why); }

 private:
  std::string name_;
};

/// Interface of the module. Thread-safe.
class Hdf5 {
 public:
  virtual ~Hdf5() = default;
  virtual std::unique_ptr<Hdf5Writer> write() const = 0;
  virtual std::unique_ptr<Hdf5Reader> read(std::string bytes, std::string name) const = 0;
};

/// A new file. Throws InputError if the module cannot be loaded.
std::unique_ptr<Hdf5Writer> write_hdf5();
/// The file of these bytes; `name` stands for it in messages. Throws InputError also if the module
/// cannot be loaded.
std::unique_ptr<Hdf5Reader> read_hdf5(std::string bytes, std::string name);

}  // namespace microswarm::io
