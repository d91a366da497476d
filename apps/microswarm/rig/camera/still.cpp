// SPDX-License-Identifier: Apache-2.0
#include "rig/camera/still.hpp"

#include <string_view>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

constexpr std::string_view genicam = "genicam:";

bool is_genicam(const std::string& source) { return source.starts_with(genicam); }

}  // namespace

bool is_camera(const std::string& source) {
  const bool is_pipe = source == "/dev/stdin" || source.starts_with("/dev/fd/");
  return (source.starts_with("/dev/") && !is_pipe) || is_genicam(source);
}

vision::AnyCameraParams camera_for(const std::string& source,
                                   const vision::AnyCameraParams& given) {
  if (!is_camera(source)) return given;
  vision::AnyCameraParams camera = given;
  if (is_genicam(source)) {
    if (!std::holds_alternative<vision::GenicamParams>(camera)) camera = vision::GenicamParams{};
    std::get<vision::GenicamParams>(camera).device = source.substr(genicam.size());
  } else {
    if (!std::holds_alternative<vision::CameraParams>(camera)) camera = vision::CameraParams{};
    std::get<vision::CameraParams>(camera).device = source;
  }
  return camera;
}

vision::AnyCameraParams find_camera(const std::string& source, const std::string& rig,
                                    const std::vector<std::string>& settings) {
  vision::AnyCameraParams given;
  if (!rig.empty()) given = rig::device_camera(rig::read_rig(rig).params).value_or(given);
  vision::AnyCameraParams camera = camera_for(source, given);
  std::visit([&](auto& params) { note_each(set_values(params, {settings, "--set"})); }, camera);
  return camera;
}

formats::Image take_picture(const std::string& source, const vision::AnyCameraParams& camera) {
  std::optional<double> given = 1;
  return take_picture(source, camera, given);
}

formats::Image take_picture(const std::string& source, const vision::AnyCameraParams& camera,
                            std::optional<double>& um_per_px) {
  if (!is_camera(source)) return read_photo(source, um_per_px);
  vision::NewestFrame live = vision::live_camera(camera_for(source, camera));
  vision::LiveFrame frame;
  const double began = steady_seconds();
  while (live.wait(frame, 0.5) || steady_seconds() < began + 10)
    if (frame.frame.index > 0 && steady_seconds() > began + 1) return frame.frame.picture;
  throw HardwareError(source + ": no picture within 10 s");
}

}  // namespace microswarm::cli
