// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "microswarm/formats/images/image.hpp"

namespace microswarm {

/// Most pictures a second of a GIF: its delays are whole hundredths of a second, and browsers slow
/// down those below two.
inline constexpr double max_gif_rate = 50;

/// Writes an animated GIF that repeats forever. A picture is stored as what differs from the one
/// before, with a palette of its own: its colours, or the 255 that giflib chooses if there are
/// more.
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

}  // namespace microswarm
