// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/vision/camera/frames.hpp"

namespace microswarm::vision {

/// State of a camera's stream.
enum class CameraState {
  opening,  ///< no picture yet
  live,
  black,   ///< pictures without light
  frozen,  ///< the same pictures repeatedly
  silent,  ///< no picture for too long
  ended,   ///< the source has no more pictures, as at the end of a file
  failed,  ///< unplugged or unreadable
};
constexpr auto enum_names(CameraState) {
  return std::array<std::pair<CameraState, std::string_view>, 7>{{{CameraState::opening, "opening"},
                                                                  {CameraState::live, "live"},
                                                                  {CameraState::black, "black"},
                                                                  {CameraState::frozen, "frozen"},
                                                                  {CameraState::silent, "silent"},
                                                                  {CameraState::ended, "ended"},
                                                                  {CameraState::failed, "failed"}}};
}

/// Settings of NewestFrame.
struct NewestFrameParams {
  std::optional<double> silent_after{};
  int frozen_after = 5;
  int black_below = 8;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.silent_after,
          s("silent_after", 1e-3, 3600, "Longest time without a frame; none: 1 s, or 3 frames."));
    visit(self.frozen_after,
          plain("frozen_after", 2, 1e6, "Number of repeated frames after which it is frozen."));
    visit(self.black_below,
          plain("black_below", 0, 255, "Grey value below which an image is black."));
  }
};

/// A frame and its time of arrival.
struct LiveFrame {
  VideoFrame frame{};
  double taken = 0;  ///< time of arrival in the program [s], by steady_seconds()
};

/// Called for every frame with its time of arrival [s], by steady_seconds().
using FrameListener = std::function<void(const VideoFrame& frame, double taken)>;

/// State and statistics of a camera's stream.
struct CameraStatus {
  CameraState state = CameraState::opening;
  int frames = 0;     ///< received so far
  int dropped = 0;    ///< of these, replaced before they were taken
  int gaps = 0;       ///< times the next one came after more than twice the usual time
  double age = 0;     ///< of the newest frame [s]; before the first one, time since the start
  std::string why{};  ///< reason in one line if silent, failed or ended early
};

/// Fetches frames in its own thread and keeps the newest; older ones are dropped and counted.
/// Thread-safe.
class NewestFrame {
 public:
  /// `name` prefixes the message that the camera is silent; the source's own errors name it
  /// already. `listener` is called in the camera's thread, after this object's destruction too if
  /// the source is still busy then.
  NewestFrame(std::unique_ptr<FrameSource> source, std::string name,
              const NewestFrameParams& params = {}, FrameListener listener = {});
  /// Returns within a second. A source that still blocks is abandoned and closed when it returns.
  ~NewestFrame();
  NewestFrame(const NewestFrame&) = delete;
  NewestFrame& operator=(const NewestFrame&) = delete;

  /// Moves the newest frame into `frame`, reusing its memory; false if it was taken already or none
  /// has arrived. Throws HardwareError "NAME: WHY" if the source failed, and while it is silent.
  bool take(LiveFrame& frame) { return wait(frame, 0); }
  /// The same after waiting up to `seconds` for a frame that arrived at `since` or later [s], by
  /// steady_seconds(); on timeout it takes the newest.
  bool wait(LiveFrame& frame, double seconds, double since = -infinity);

  CameraStatus status() const;

 private:
  struct Shared;

  std::string name_;
  NewestFrameParams params_;
  std::shared_ptr<Shared> shared_;
};

}  // namespace microswarm::vision
