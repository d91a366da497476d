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

namespace microswarm {

/// What comes from a camera by now.
enum class CameraState {
  opening,  ///< no picture yet
  live,
  black,   ///< pictures without light
  frozen,  ///< the same pictures again and again
  silent,  ///< no picture for too long
  ended,   ///< the source has no more, as a file at its end
  failed,  ///< unplugged, or it cannot be read any more
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
  std::optional<double> silent_after;
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

/// A frame and when it came.
struct LiveFrame {
  VideoFrame frame;
  double taken = 0;  ///< when it reached the program [s], by steady_seconds()
};

/// Hears of every frame with the time at which it reached the program [s], by steady_seconds().
using FrameListener = std::function<void(const VideoFrame& frame, double taken)>;

/// How a camera does.
struct CameraStatus {
  CameraState state = CameraState::opening;
  int frames = 0;   ///< that came so far
  int dropped = 0;  ///< of these, that nobody took before the next one came
  double age = 0;   ///< of the newest [s], before the first since the start
  std::string why;  ///< one line for people, when silent, failed, or ended before its end
};

/// Fetches frames in a thread of its own, so that whoever needs one gets the newest at once: older
/// ones are dropped and counted. Safe to use from several threads.
class NewestFrame {
 public:
  /// `name` stands before the complaint that it is silent; what the source throws names it itself.
  /// `heard` is called in the camera's thread, also after this object's end until the source comes
  /// back.
  NewestFrame(std::unique_ptr<FrameSource> source, std::string name,
              const NewestFrameParams& params = {}, FrameListener heard = {});
  /// Returns within a second, even when the source never does; it is then given up when it does.
  ~NewestFrame();
  NewestFrame(const NewestFrame&) = delete;
  NewestFrame& operator=(const NewestFrame&) = delete;

  /// The newest frame into `frame`, whose memory is used again; false when it was taken already, or
  /// none has come. Throws HardwareError "NAME: WHY" when the source failed, and while it is
  /// silent.
  bool take(LiveFrame& frame) { return wait(frame, 0); }
  /// The same, after waiting for up to `seconds` for a frame that came at `since` or later [s], by
  /// steady_seconds(); without one, the newest is taken as it is.
  bool wait(LiveFrame& frame, double seconds, double since = -infinity);

  CameraStatus status() const;

 private:
  struct Shared;

  std::string name_;
  NewestFrameParams params_;
  std::shared_ptr<Shared> shared_;
};

}  // namespace microswarm
