// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/camera/raw_pixels.hpp"

namespace microswarm::vision {

/// An open camera whose stream has started.
class CameraDevice {
 public:
  explicit CameraDevice(std::string name) : name_(std::move(name)) {}
  virtual ~CameraDevice() = default;
  CameraDevice(const CameraDevice&) = delete;
  CameraDevice& operator=(const CameraDevice&) = delete;

  const std::string& name() const { return name_; }
  /// Throws HardwareError "NAME: WHY".
  [[noreturn]] void fail(const std::string& why) const { throw HardwareError(name_ + ": " + why); }

  /// Actual frame rate [Hz], if the camera reports it.
  virtual std::optional<double> rate() const = 0;
  /// Waits up to `seconds` for the next picture's data, which may be marked as damaged; nothing on
  /// timeout. The data is valid until the next call. Throws HardwareError if the camera is gone.
  virtual std::optional<RawPicture> take(double seconds) = 0;

 private:
  std::string name_;
};

}  // namespace microswarm::vision
