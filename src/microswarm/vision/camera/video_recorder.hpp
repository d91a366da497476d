// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm {

/// A video that was recorded.
struct RecordedVideo {
  std::filesystem::path file;
  int frames = 0;       ///< in the file
  int dropped = 0;      ///< that came too fast to be written
  std::string trouble;  ///< why it is not complete, one line; empty if it is
};

/// Records pictures without loss, grey as FFV1 and colours as HuffYUV, in a Matroska or AVI file,
/// and beside it a CSV with the time of each frame. A thread of its own writes; what comes while
/// its queue is full is dropped and counted. During the recording both files are called
/// NAME.part.EXTENSION.
class VideoRecorder {
 public:
  /// Opens FILE, which ends in .mkv or .avi, with this nominal rate [Hz]. Throws InputError
  /// "FILE: cannot write: REASON".
  VideoRecorder(const std::filesystem::path& file, double rate);
  /// Ends the recording; the files keep their temporary names without finish().
  ~VideoRecorder();
  VideoRecorder(const VideoRecorder&) = delete;
  VideoRecorder& operator=(const VideoRecorder&) = delete;

  /// File of the times of a video.
  static std::filesystem::path times_of(const std::filesystem::path& video);
  /// Takes a frame that reached the program at `taken` [s], by steady_seconds(). It never waits for
  /// the disk, can be called from any thread, and is of no effect after the recorder's end.
  FrameListener input() const;
  /// Sets when the clock of the times was zero [s], by steady_seconds(). Until then frames wait in
  /// the queue; those from before zero have negative times.
  void begin(double zero);
  /// Writes what is in the queue, checks that the file holds every frame, and gives both files
  /// their names. The second call does nothing.
  const RecordedVideo& finish();

 private:
  struct Shared;
  class Writer;

  std::shared_ptr<Shared> shared_;
  std::unique_ptr<Writer> writer_;
};

}  // namespace microswarm
