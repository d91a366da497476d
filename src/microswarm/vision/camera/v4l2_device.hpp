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

namespace microswarm::vision {

/// An open V4L2 camera and its buffers. No call blocks for long. All throw HardwareError
/// "DEVICE: WHY".
class V4l2Device : public CameraDevice {
 public:
  /// Opens the device. Throws if it cannot capture pictures.
  explicit V4l2Device(std::string name);
  ~V4l2Device() override;
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  /// Sends a request to the driver; returns 0 or the error number.
  int ask(unsigned long request, void* argument) const;

  /// Sets the part of the sensor that is read; throws unless the camera accepts it exactly.
  void set_region(const SensorRegion& region);
  /// Sets format and size of the pictures; throws unless the camera accepts them exactly.
  void set_format(std::optional<PixelFormat> format, int width, int height);
  /// Requests a rate [Hz]; rate() returns the actual one if the camera reports it.
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

}  // namespace microswarm::vision
