// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm::vision {

/// Supported pixel formats of GenICam cameras, named as in GenICam's standard.
enum class GenicamFormat {
  mono8,
  mono10,
  mono12,
  mono16,
  bayer_rg8,
  bayer_gr8,
  bayer_gb8,
  bayer_bg8,
  rgb8,
  bgr8,
  yuv422_8,
  yuv422_8_uyvy
};
constexpr auto enum_names(GenicamFormat) {
  return std::array<std::pair<GenicamFormat, std::string_view>, 12>{
      {{GenicamFormat::mono8, "Mono8"},
       {GenicamFormat::mono10, "Mono10"},
       {GenicamFormat::mono12, "Mono12"},
       {GenicamFormat::mono16, "Mono16"},
       {GenicamFormat::bayer_rg8, "BayerRG8"},
       {GenicamFormat::bayer_gr8, "BayerGR8"},
       {GenicamFormat::bayer_gb8, "BayerGB8"},
       {GenicamFormat::bayer_bg8, "BayerBG8"},
       {GenicamFormat::rgb8, "RGB8"},
       {GenicamFormat::bgr8, "BGR8"},
       {GenicamFormat::yuv422_8, "YUV422_8"},
       {GenicamFormat::yuv422_8_uyvy, "YUV422_8_UYVY"}}};
}

/// Settings of a GenICam camera (GigE Vision, USB3 Vision). Settings that are not given stay
/// unchanged in the camera. It runs freely: triggers are switched off.
struct GenicamParams {
  static constexpr std::string_view type_name = "genicam";
  std::string device{};
  std::optional<int> width{};
  std::optional<int> height{};
  std::optional<int> x{};
  std::optional<int> y{};
  std::optional<double> rate{};
  std::optional<GenicamFormat> pixel_format{};
  std::optional<double> exposure{};
  std::optional<double> gain{};
  std::optional<int> packet_size{};
  NewestFrameParams watch{};

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.device,
          plain("device", "Id, serial number or address; empty: the first one found."));
    visit(self.width,
          px("width", 1, formats::max_image_side, "Width of a picture; none: as it is."));
    visit(self.height,
          px("height", 1, formats::max_image_side, "Height of a picture; none: as it is."));
    visit(self.x, px("x", 0, 1e6, "Left edge on the sensor; none: as it is."));
    visit(self.y, px("y", 0, 1e6, "Upper edge on the sensor; none: as it is."));
    visit(self.rate, hz("rate", 0.01, 1e4, "Frame rate; none: as it is."));
    visit(self.pixel_format, plain("pixel_format", "Format of the data; none: as it is."));
    visit(self.exposure, ms("exposure", 1e-3, 1e5, "Exposure time; none: as it is."));
    visit(self.gain, plain("gain", -1e6, 1e6, "Gain in the camera's own unit; none: as it is."));
    visit(self.packet_size,
          plain("packet_size", 576, 65535, "Bytes of a GigE Vision packet; none: negotiated."));
    visit(self.watch, plain("watch", "Detection of a silent, frozen or black camera."));
  }
};

/// Whether these are settings of Aravis's simulated test camera "Fake_1", found by this id only.
inline bool is_fake(const GenicamParams& params) { return params.device.starts_with("Fake_"); }

}  // namespace microswarm::vision
