// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "microswarm/formats/images/deep_image.hpp"

namespace microswarm::formats {

/// Whether the bytes begin as a TIFF or a BigTIFF does.
bool is_tiff(std::span<const std::byte> bytes);

/// Pages of a TIFF or BigTIFF, read one after the other in linear time. Strips and tiles, in every
/// compression of libtiff. The size of a page is checked before decoding.
class TiffPages {
 public:
  /// Opens a file. All members throw InputError "FILE: WHY".
  explicit TiffPages(const std::filesystem::path& file);
  /// Opens a file in memory, which must outlive the object; `name` is its name in messages.
  TiffPages(std::span<const std::byte> bytes, std::string_view name);
  ~TiffPages();
  TiffPages(const TiffPages&) = delete;
  TiffPages& operator=(const TiffPages&) = delete;

  int count() const { return count_; }
  /// Pixels of the next page: one channel (grey) or three (red, green, blue) without
  /// transparency. May be called at most `count()` times.
  DecodedImage next();

 private:
  struct File;
  void count_pages();

  std::string name_;
  std::unique_ptr<File> file_;
  int count_ = 0;
  int next_ = 0;
};

}  // namespace microswarm::formats
