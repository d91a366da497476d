// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cv {
class Mat;
}  // namespace cv

namespace microswarm::formats {

// Photographs and videos by OpenCV's imgcodecs and videoio and by FFmpeg. These depend on some 150
// shared libraries, 0.2 s of a program's start, so they form a module that is loaded at the first
// use.

/// A photograph: rows of 8-bit samples, grey or red, green, blue.
struct Photograph {
  int width = 0;     ///< [px]
  int height = 0;    ///< [px]
  int channels = 1;  ///< 1 or 3
  std::vector<std::uint8_t> samples{};
};

/// A video that is open for reading.
class VideoInput {
 public:
  virtual ~VideoInput() = default;
  /// The next picture, blue, green, red, valid until the next call; false at the end or where it
  /// cannot be decoded.
  virtual bool read(cv::Mat& picture) = 0;

  int width = 0;   ///< as shown [px]
  int height = 0;  ///< as shown [px]
  /// Width of the stored pixels, heights being 1. Pictures are stretched along their shorter side,
  /// so that those read have square pixels.
  double pixel_aspect = 1;
  bool is_cut = false;       ///< known when `read` fails: the file ends within a picture
  double rate = 0;           ///< mean frame rate [Hz]; 0 if unknown
  double picture_count = 0;  ///< pictures shown, by the file's header; 0 if unknown
  double end = 0;            ///< duration of the pictures by the header [s]; 0 if unknown
  /// To which times are rounded [s]; 0 in AVI, which numbers pictures, and GIF, whose delays are
  /// exact.
  double tick = 0;
  /// When the last picture read is shown [s], by the file.
  std::optional<double> time;
};

/// A video that is open for writing. The destructor writes its end.
class VideoOutput {
 public:
  virtual ~VideoOutput() = default;
  /// Adds a picture, grey or blue, green, red.
  virtual void write(const cv::Mat& picture) = 0;
  /// Writes the end; the errno of the first picture or part that was not written, or 0.
  virtual int finish() = 0;
};

/// Encoding of a video.
enum class VideoCodec { h264, mpeg4, huffyuv, ffv1 };

/// Format of a video to write.
struct VideoForm {
  VideoCodec codec = VideoCodec::h264;
  double rate = 30;  ///< frame rate [Hz]
  int width = 0;     ///< [px]
  int height = 0;    ///< [px]
  bool colours = true;
};

/// Pictures that a decoder or encoder may hold.
struct HeldPictures {
  int threads = 1;     ///< each holds one or two
  int ahead = 0;       ///< at which an encoder looks before it writes one
  int reordered = 0;   ///< between two that they refer to
  int references = 1;  ///< that others refer to
};

/// Memory that an encoder may take for the pictures it holds, about, if one of them fits [bytes].
inline constexpr std::int64_t max_held_bytes = 256 << 20;

/// As many pictures of this size as fit into max_held_bytes, at most what encoders usually hold.
HeldPictures held_pictures(int width, int height, unsigned cores);

/// Interface of the module. Thread-safe.
class Media {
 public:
  virtual ~Media() = default;
  /// A JPEG or BMP as it is stored, not turned; without samples if they cannot be decoded.
  virtual Photograph decode(std::span<const std::byte> bytes) const = 0;
  /// Opens a video; null if it cannot be read.
  virtual std::unique_ptr<VideoInput> open(const std::filesystem::path& file) const = 0;
  /// Creates a video, of H.264 with at most held_pictures in memory; null without such an encoder.
  /// If the file cannot be written, it is null too, or `finish` of the video returns why.
  virtual std::unique_ptr<VideoOutput> create(const std::filesystem::path& file,
                                              const VideoForm& form) const = 0;
  /// Pictures in a video, counted without decoding them; 0 if it cannot be read.
  virtual int count_pictures(const std::filesystem::path& file) const = 0;
};

/// The module, loaded by the first call. Throws InputError if it cannot be loaded.
const Media& media();

}  // namespace microswarm::formats
