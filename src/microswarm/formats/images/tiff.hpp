// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/formats/images/deep_image.hpp"
#include "microswarm/formats/images/tiff_description.hpp"

namespace microswarm::formats {

/// Whether the bytes begin as a TIFF or a BigTIFF does.
bool is_tiff(std::span<const std::byte> bytes);

/// Pages of a TIFF or BigTIFF. Strips and tiles, in every
/// compression of libtiff; samples of 1 to 16 bits, signed ones, and whole or floating ones of 32
/// and 64 bits. What is transparent is shown in front of white. Pages are turned by their
/// orientation, or by that of the first. The size of a page is checked before decoding. A file in
/// the layout that ImageJ gives those above 4 GB, one directory and the pages
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
  /// Notes on assumptions and on samples that are left out, a line each.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Pixels of the next page: one channel (grey) or three (red, green, blue), in front of white.
  /// May be called while it is one of `count()`.
  DecodedImage next();
  /// 1 for each pixel of the next page, which stays the next, that is not opaque; empty for a page
  /// without transparency.
  std::vector<std::uint8_t> transparency();
  /// Chooses one of `description().pixel_channels`, from 0; the first without a choice.
  void take_channel(int channel);
  /// Makes this page the next one, 0 to `count()` - 1; in linear time for any ascending or
  /// descending order.
  void go_to(int page);

 private:
  struct File;
  void count_pages();
  bool may_be_in_row(bool is_cut);
  void require_known(bool known, int channels) const;
  void step();

  std::string name_;
  std::unique_ptr<File> file_;
  TiffDescription description_;
  std::string why_fewer_;
  std::vector<std::string> notes_;
  int orientation_ = 0;  ///< of the first page; 0: no tag
  int count_ = 0;
  int next_ = 0;
};

}  // namespace microswarm::formats
