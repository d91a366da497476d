// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/camera.hpp"

#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/vision/camera/v4l2_controls.hpp"
#include "microswarm/vision/camera/v4l2_device.hpp"

namespace microswarm {
namespace {

constexpr double longest_pause = 5;     // [s] between pictures, beyond their exposure
constexpr int max_damaged_frames = 10;  // in a row

class Camera : public FrameSource {
 public:
  explicit Camera(const CameraParams& p)
      : device_(p.device),
        pause_(std::ceil(longest_pause + 1e-3 * p.exposure.value_or(0) +
                         (p.rate < 1 ? 2 / p.rate : 0))) {
    if (p.region) device_.set_region(*p.region);
    device_.set_format(p.pixel_format, p.width, p.height);
    rate_ = device_.set_rate(p.rate);
    set_controls(device_, p);
    device_.start();
  }

  bool next(VideoFrame& frame) override {
    std::string why;
    for (int damaged = 0; damaged < max_damaged_frames; ++damaged) {
      const auto raw = device_.take(pause_);
      if (!raw) device_.fail("gives no picture for " + number_text(pause_) + " s");
      why = take(*raw, frame.picture);
      if (!why.empty()) continue;
      const double now = steady_seconds();
      if (frames_ == 0) began_ = now;
      frame.index = frames_++;
      frame.t = now - began_;
      return true;
    }
    device_.fail("gives damaged pictures, " + why);
  }
  std::optional<int> count() const override { return std::nullopt; }
  std::optional<double> rate() const override { return rate_; }

 private:
  /// What is wrong with the data; empty when they became a picture.
  static std::string take(const RawPicture& raw, Image& picture) {
    if (raw.bytes.empty()) return "the last: the driver calls it damaged";
    try {
      take_raw(raw, "the last", picture);
      return {};
    } catch (const InputError& error) {
      return error.what();
    }
  }

  V4l2Device device_;
  double pause_;
  std::optional<double> rate_;
  int frames_ = 0;
  double began_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> open_camera(const CameraParams& params) {
  return std::make_unique<Camera>(params);
}

}  // namespace microswarm
