// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm::vision {

/// Result of a recording.
struct RecordedVideo {
  std::filesystem::path file{};
  int frames = 0;         ///< in the file
  int dropped = 0;        ///< frames that arrived too fast to be written
  std::string trouble{};  ///< why the video is incomplete, one line; empty if it is complete
};

/// Records pictures without loss, grey as FFV1 and colour as HuffYUV, in a Matroska or AVI file,
/// and beside it a CSV with the time of each frame. Its own thread writes; frames that arrive
/// while its queue is full are dropped and counted. During the recording both files are named
/// NAME.part.EXTENSION.
class VideoRecorder {
 public:
  /// Opens FILE (.mkv or .avi) with a nominal rate [Hz]; 0: that of its first pictures, which the
  /// video has also where its CSV is lost. Throws InputError "FILE: cannot write: REASON".
  VideoRecorder(const std::filesystem::path& file, double rate);
  /// Ends the recording; without finish() the files keep their temporary names.
  ~VideoRecorder();
  VideoRecorder(const VideoRecorder&) = delete;
  VideoRecorder& operator=(const VideoRecorder&) = delete;

  /// Path of the file with a video's times.
  static std::filesystem::path times_file(const std::filesystem::path& video);
  /// Listener that queues a frame with its time of arrival. It never waits for the disk, can be
  /// called from any thread, and does nothing after the recorder's destruction.
  FrameListener input() const;
  /// Sets the zero of the times [s], by steady_seconds(). Until then frames stay in the queue;
  /// those from before zero have negative times.
  void begin(double zero);
  /// Writes the queue, checks that the file holds every frame, and renames both files. A second
  /// call does nothing.
  const RecordedVideo& finish();

 private:
  struct Shared;
  class Writer;

  std::shared_ptr<Shared> shared_;
  std::unique_ptr<Writer> writer_;
};

}  // namespace microswarm::vision
