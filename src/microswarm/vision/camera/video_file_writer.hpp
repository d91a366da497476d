// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "microswarm/formats/images/image.hpp"

namespace microswarm::vision {

/// Writes pictures to a video file: an animated GIF (.gif), else H.264, which browsers play, else
/// MPEG-4; without a codec, PNG files in a folder beside it, named as the file without extension.
/// The file appears under its name on commit(). Sides should be even.
class VideoFileWriter {
 public:
  /// `rate` is in 1/s, at most max_gif_rate for a GIF. Throws InputError "PATH: cannot write:
  /// REASON".
  VideoFileWriter(std::filesystem::path file, double rate);
  ~VideoFileWriter();
  VideoFileWriter(const VideoFileWriter&) = delete;
  VideoFileWriter& operator=(const VideoFileWriter&) = delete;

  /// Appends a colour picture; all must have one size. Throws InputError as check_image_size.
  void add(const formats::Image& picture);
  /// Ends the video and returns the path of the file or folder; nothing without pictures. Throws
  /// WriteError "PATH: cannot write: REASON", and leaves no file, where a picture was not written.
  std::optional<std::filesystem::path> commit();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace microswarm::vision
