// SPDX-License-Identifier: Apache-2.0
#pragma once

// HDF5 for the module alone: identifiers, and one thread at a time.

#include <hdf5.h>

#include <atomic>
#include <string>
#include <utility>

#include "microswarm/core/execution/mutex.hpp"

namespace microswarm::io {

constexpr hsize_t max_values = 100'000'000;    // of a dataset
constexpr std::size_t image_growth = 1 << 20;  // [bytes]

/// HDF5 identifier that closes itself.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  Id& operator=(Id&&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): as HDF5 wants it
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Each use of HDF5 while an instance lives: one thread at a time, and without HDF5's own error
/// printing. It also disables HDF5's clean-up at program exit, which would complain about damaged
/// files; everything here is closed explicitly.
class Use {
 public:
  Use() : lock_(mutex()) {
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  ~Use() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

 private:
  static RecursiveMutex& mutex() {
    static RecursiveMutex all;
    return all;
  }

  std::lock_guard<RecursiveMutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// Name of a file in memory. HDF5 takes two open files of one name for the same file.
inline std::string unused_name() {
  static std::atomic<std::uint64_t> count = 0;
  return "record " + std::to_string(++count);
}

}  // namespace microswarm::io
