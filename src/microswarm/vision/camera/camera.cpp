// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/camera.hpp"

#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/vision/camera/genicam_device.hpp"
#include "microswarm/vision/camera/v4l2_controls.hpp"
#include "microswarm/vision/camera/v4l2_device.hpp"

namespace microswarm::vision {
namespace {

constexpr double longest_pause = 5;     // [s] between pictures, in addition to the exposure
constexpr int max_damaged_frames = 10;  // in a row

std::unique_ptr<CameraDevice> open_device(const CameraParams& p) {
  auto device = std::make_unique<V4l2Device>(p.device);
  if (p.region) device->set_region(*p.region);
  device->set_format(p.pixel_format, p.width, p.height);
  device->set_rate(p.rate);
  set_controls(*device, p);
  device->start();
  return device;
}

std::unique_ptr<CameraDevice> open_device(const GenicamParams& p) { return open_genicam(p); }

/// Time without a picture after which the camera has failed [s].
double frame_pause(double exposure_ms, double rate) {
  return std::ceil(longest_pause + 1e-3 * exposure_ms + (rate < 1 ? 2 / rate : 0));
}

class Camera : public FrameSource {
 public:
  Camera(std::unique_ptr<CameraDevice> device, double pause)
      : device_(std::move(device)), pause_(pause) {}

  bool next(VideoFrame& frame) override {
    std::string why;
    for (int damaged = 0; damaged < max_damaged_frames; ++damaged) {
      const auto raw = device_->take(pause_);
      if (!raw) device_->fail("gives no picture for " + number_text(pause_) + " s");
      why = take(*raw, frame.picture);
      if (!why.empty()) continue;
      const double now = steady_seconds();
      if (frames_ == 0) began_ = now;
      frame.index = frames_++;
      frame.t = now - began_;
      return true;
    }
    device_->fail("gives damaged pictures, " + why);
  }
  std::optional<int> count() const override { return std::nullopt; }
  std::optional<double> rate() const override { return device_->rate(); }

 private:
  /// Decodes the data; returns why it failed, empty on success.
  static std::string take(const RawPicture& raw, formats::Image& picture) {
    if (!raw.damage.empty()) return "the last: " + std::string(raw.damage);
    try {
      take_raw(raw, "the last", picture);
      return {};
    } catch (const InputError& error) {
      return error.what();
    }
  }

  std::unique_ptr<CameraDevice> device_;
  double pause_;
  int frames_ = 0;
  double began_ = 0;
};

}  // namespace

std::string device_name(const AnyCameraParams& params) {
  return std::visit(
      Overloaded{[](const CameraParams& v4l2) { return v4l2.device; },
                 [](const GenicamParams& genicam) { return "genicam:" + genicam.device; }},
      params);
}

std::unique_ptr<FrameSource> open_camera(const AnyCameraParams& params) {
  return std::visit(
      [](const auto& p) -> std::unique_ptr<FrameSource> {
        std::unique_ptr<CameraDevice> device = open_device(p);
        const std::optional<double> rate = device->rate();
        return std::make_unique<Camera>(std::move(device),
                                        frame_pause(p.exposure.value_or(0), rate.value_or(1)));
      },
      params);
}

NewestFrame live_camera(const AnyCameraParams& params) {
  const NewestFrameParams watch = std::visit([](const auto& p) { return p.watch; }, params);
  return {open_camera(params), device_name(params), watch};
}

}  // namespace microswarm::vision
