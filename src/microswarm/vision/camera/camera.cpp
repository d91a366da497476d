// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/camera.hpp"

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>
#include <system_error>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/vision/image/mat.hpp"

namespace microswarm {
namespace {

constexpr double exposure_steps_per_ms = 10;  // V4L2 counts exposure in units of 100 µs
constexpr double manual_exposure = 1;         // V4L2_EXPOSURE_MANUAL

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

class Camera : public FrameSource {
 public:
  explicit Camera(const CameraParams& p) : name_(p.device) {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    check_device();
    if (!video_.open(name_, cv::CAP_V4L2)) fail("is no camera that can be opened");
    video_.set(cv::CAP_PROP_FRAME_WIDTH, p.width);
    video_.set(cv::CAP_PROP_FRAME_HEIGHT, p.height);
    video_.set(cv::CAP_PROP_FPS, p.rate);
    if (p.exposure) set_exposure(*p.exposure);
    const auto width = static_cast<int>(video_.get(cv::CAP_PROP_FRAME_WIDTH));
    const auto height = static_cast<int>(video_.get(cv::CAP_PROP_FRAME_HEIGHT));
    if (width != p.width || height != p.height)
      fail("gives pictures of " + size_text(width, height) + " pixels, asked for were " +
           size_text(p.width, p.height));
  }

  bool next(VideoFrame& frame) override {
    if (!video_.read(mat_) || mat_.empty()) fail("gives no more pictures");
    const double now = steady_seconds();
    if (frames_ == 0) began_ = now;
    frame.index = frames_++;
    frame.t = now - began_;
    take_picture(mat_, frame.picture);
    return true;
  }
  std::optional<int> count() const override { return std::nullopt; }
  std::optional<double> rate() const override {
    const double told = video_.get(cv::CAP_PROP_FPS);
    if (!(told > 0 && told < 1e6)) return std::nullopt;
    return told;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw HardwareError(name_ + ": " + why); }

  void check_device() const {
    if (::access(name_.c_str(), R_OK | W_OK) != 0)
      fail("cannot open: " + std::generic_category().message(errno));
    if (!std::filesystem::is_character_file(name_)) fail("is no camera");
  }

  void set_exposure(double ms) {
    const double steps = std::round(exposure_steps_per_ms * ms);
    if (!video_.set(cv::CAP_PROP_AUTO_EXPOSURE, manual_exposure) ||
        !video_.set(cv::CAP_PROP_EXPOSURE, steps))
      fail("takes no exposure");
  }

  std::string name_;
  cv::VideoCapture video_;
  cv::Mat mat_;
  int frames_ = 0;
  double began_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> open_camera(const CameraParams& params) {
  return std::make_unique<Camera>(params);
}

}  // namespace microswarm
