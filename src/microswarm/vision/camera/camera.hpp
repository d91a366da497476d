// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm {

/// Settings of a camera on V4L2.
struct CameraParams {
  static constexpr std::string_view type_name = "v4l2";
  std::string device = "/dev/video0";
  int width = 640;
  int height = 480;
  double rate = 30;
  std::optional<double> exposure;
  NewestFrameParams watch;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.device, {"device", Unit::none, {}, "Device file."});
    visit(self.width, {"width", Unit::px, {1, max_image_side}, "Width of a picture."});
    visit(self.height, {"height", Unit::px, {1, max_image_side}, "Height of a picture."});
    visit(self.rate, {"rate", Unit::hz, {0.01, 1e4}, "Requested frame rate."});
    visit(self.exposure, {"exposure", Unit::ms, {0.1, 1e5}, "Exposure time; none: automatic."});
    visit(self.watch, {"watch", Unit::none, {}, "Detection of a silent, frozen or black camera."});
  }
};

/// Opens a camera whose pictures come one by one, each waited for. The rate that the camera really
/// has is `rate()` of the source. Throws HardwareError "DEVICE: WHY" when there is no such device,
/// it is no camera, or it gives pictures of another size; next() does so when it is unplugged.
std::unique_ptr<FrameSource> open_camera(const CameraParams& params);

/// A camera whose newest frame is at hand; errors as above.
inline NewestFrame live_camera(const CameraParams& params) {
  return {open_camera(params), params.device, params.watch};
}

}  // namespace microswarm
