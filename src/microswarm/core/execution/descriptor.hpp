// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <utility>

namespace microswarm {

/// An open file descriptor, closed with this object.
class Descriptor {
 public:
  Descriptor() = default;
  /// Takes over what a system call has opened; negative: nothing.
  explicit Descriptor(int file) : file_(file) {}
  Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  explicit operator bool() const { return file_ >= 0; }
  int get() const { return file_; }
  /// Closes now; false, with errno, if a delayed write failed.
  bool close();

 private:
  int file_ = -1;
};

/// Opens a file, also with O_CLOEXEC; nothing, with errno, if it cannot be opened. A file that is
/// created has the rights 0666 less the umask.
Descriptor open_descriptor(const std::filesystem::path& path, int flags);

}  // namespace microswarm
