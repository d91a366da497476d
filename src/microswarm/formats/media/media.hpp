// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

namespace cv {
class Mat;
}  // namespace cv

namespace microswarm {

// Photographs and videos, as OpenCV's imgcodecs and videoio decode and encode them. These two bring
// some 150 shared libraries, 0.2 s of a program's start, so they are in a module of their own that
// is loaded at the first use.

/// A video that is open for reading.
class VideoInput {
 public:
  virtual ~VideoInput() = default;
  /// The next picture, grey or blue, green, red; false at the end or where it cannot be decoded.
  virtual bool read(cv::Mat& picture) = 0;

  int width = 0;             ///< [px]
  int height = 0;            ///< [px]
  double rate = 0;           ///< pictures a second, as the file says
  double picture_count = 0;  ///< as the file says
};

/// A video that is open for writing. Its end is written when it is destroyed.
class VideoOutput {
 public:
  virtual ~VideoOutput() = default;
  /// Adds a picture, grey or blue, green, red.
  virtual void write(const cv::Mat& picture) = 0;
};

/// How a video is encoded.
enum class VideoCodec { h264, mpeg4, huffyuv, ffv1 };

/// What to write.
struct VideoForm {
  VideoCodec codec = VideoCodec::h264;
  double rate = 30;  ///< pictures a second
  int width = 0;     ///< [px]
  int height = 0;    ///< [px]
  bool colours = true;
};

/// What the module does. Its functions may be called from several threads at once.
class Media {
 public:
  virtual ~Media() = default;
  /// Pixels of a JPEG or BMP, grey or blue, green, red; empty if they cannot be decoded. `bytes` is
  /// one row of 8 bits.
  virtual cv::Mat decode(const cv::Mat& bytes) const = 0;
  /// Null if it cannot be read as a video.
  virtual std::unique_ptr<VideoInput> open(const std::filesystem::path& file) const = 0;
  /// Null if there is no such encoder, or the file cannot be written.
  virtual std::unique_ptr<VideoOutput> create(const std::filesystem::path& file,
                                              const VideoForm& form) const = 0;
  /// Pictures in a video, counted without decoding them; 0 if it cannot be read.
  virtual int count_pictures(const std::filesystem::path& file) const = 0;
};

/// The module, loaded by the first call. Throws InputError if it cannot be loaded.
const Media& media();

}  // namespace microswarm
