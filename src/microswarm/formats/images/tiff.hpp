// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "microswarm/formats/images/deep_image.hpp"
#include "microswarm/formats/images/tiff_description.hpp"

namespace microswarm::formats {

/// Whether the bytes begin as a TIFF or a BigTIFF does.
bool is_tiff(std::span<const std::byte> bytes);

/// Pages of a TIFF or BigTIFF. Strips and tiles, in every
/// compression of libtiff; samples of 1 to 16 bits, signed ones, and whole or floating ones of 32
/// and 64 bits. Pages are turned by their orientation. The size of a page is checked before
/// decoding. A file in the layout that ImageJ gives those above 4 GB, one directory and the pages
/// one after the other behind its first, has all of them.
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
  /// Why there are fewer pages than the file says, "FILE: WHY"; empty if there are not.
  const std::string& why_fewer() const { return why_fewer_; }
  /// Description that ImageJ, SCIFIO, tifffile or OME wrote.
  const TiffDescription& description() const { return description_; }

  /// Pixels of the next page: one channel (grey) or three (red, green, blue) without
  /// transparency. May be called while it is one of `count()`.
  DecodedImage next();
  /// Makes this page the next one, 0 to `count()` - 1; in linear time for any ascending or
  /// descending order.
  void go_to(int page);

 private:
  struct File;
  void count_pages();
  void step();

  std::string name_;
  std::unique_ptr<File> file_;
  TiffDescription description_;
  std::string why_fewer_;
  int count_ = 0;
  int next_ = 0;
};

}  // namespace microswarm::formats
