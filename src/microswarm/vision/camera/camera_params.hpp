// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"
#include "microswarm/vision/camera/raw_pixels.hpp"

namespace microswarm::vision {

/// Part of a camera's sensor [px].
struct SensorRegion {
  int x = 0;
  int y = 0;
  int width = 640;
  int height = 480;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.x, px("x", 0, 1e6, "Left edge."));
    visit(self.y, px("y", 0, 1e6, "Upper edge."));
    visit(self.width, px("width", 1, 1e6, "Width of the region."));
    visit(self.height, px("height", 1, 1e6, "Height of the region."));
  }
};

/// Settings of a V4L2 camera.
struct CameraParams {
  static constexpr std::string_view type_name = "v4l2";
  std::string device = "/dev/video0";
  int width = 640;
  int height = 480;
  double rate = 30;
  std::optional<PixelFormat> pixel_format{};
  std::optional<SensorRegion> region{};
  std::optional<double> exposure{};
  std::optional<int> gain{};
  std::optional<int> white_balance{};
  std::optional<int> focus{};
  NewestFrameParams watch{};

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.device, plain("device", "Device file."));
    visit(self.width, px("width", 1, formats::max_image_side, "Width of a picture."));
    visit(self.height, px("height", 1, formats::max_image_side, "Height of a picture."));
    visit(self.rate, hz("rate", 0.01, 1e4, "Requested frame rate."));
    visit(self.pixel_format,
          plain("pixel_format", "Format of the data; none: as the driver has it."));
    visit(self.region, plain("region", "Part of the sensor that is read; none: as it is."));
    visit(self.exposure, ms("exposure", 0.1, 1e5, "Exposure time; none: automatic."));
    visit(self.gain, plain("gain", -1e6, 1e6, "Gain in the camera's own unit; none: automatic."));
    visit(self.white_balance, plain("white_balance", 1000, 20000,
                                    "Colour temperature of the light in K; none: automatic."));
    visit(self.focus,
          plain("focus", -1e6, 1e6, "Focus in the camera's own unit; none: automatic."));
    visit(self.watch, plain("watch", "Detection of a silent, frozen or black camera."));
  }
};

}  // namespace microswarm::vision
