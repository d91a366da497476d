// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/vision/camera/camera_device.hpp"
#include "microswarm/vision/camera/camera_params.hpp"

namespace microswarm {

/// An open camera of V4L2 and its buffers. No call waits for long. All throw HardwareError
/// "DEVICE: WHY".
class V4l2Device : public CameraDevice {
 public:
  /// Opens the device. Throws if it is no camera that gives pictures.
  explicit V4l2Device(std::string name);
  ~V4l2Device() override;
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  /// Asks the driver; the result is 0 or the number of the error.
  int ask(unsigned long request, void* argument) const;

  /// Reads this part of the sensor only; the region that the camera really takes must be this one.
  void set_region(const SensorRegion& region);
  /// Sets format and size of the pictures; what the camera really has must be the same.
  void set_format(std::optional<PixelFormat> format, int width, int height);
  /// Asks for a rate [Hz]; rate() is then the one that the camera really has, if it tells.
  void set_rate(double rate);

  /// Starts the stream.
  void start();
  std::optional<double> rate() const override { return rate_; }
  std::optional<RawPicture> take(double seconds) override;

 private:
  bool wait(double seconds) const;
  void enqueue(std::uint32_t index) const;
  PixelFormat readable(std::uint32_t fourcc) const;
  [[noreturn]] void fail_format(std::uint32_t wanted) const;
  std::string offered_formats() const;

  Descriptor file_;
  std::optional<double> rate_;
  std::vector<std::span<std::byte>> buffers_;
  std::optional<std::uint32_t> taken_;
  RawPicture form_;
};

}  // namespace microswarm
