// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {

/// Maximum rate of a GIF [1/s]: its delays are multiples of 10 ms, and browsers play delays below
/// 20 ms more slowly.
inline constexpr double max_gif_rate = 50;

/// Writes an animated GIF that repeats without limit. A picture is stored as its difference from
/// the previous one, with its own palette: its colours, or 255 chosen by giflib if there are more.
class GifWriter {
 public:
  /// `rate` is in 1/s, at most max_gif_rate. Throws InputError "PATH: cannot write: REASON".
  GifWriter(const std::filesystem::path& file, double rate);
  ~GifWriter();
  GifWriter(const GifWriter&) = delete;
  GifWriter& operator=(const GifWriter&) = delete;

  /// Appends a colour picture; all have one size, at most 65535 pixels a side.
  void add(const Image& picture);
  /// Ends the file; errors as above.
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace microswarm::formats
