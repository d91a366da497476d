// SPDX-License-Identifier: Apache-2.0
#include "rig/still.hpp"

#include <variant>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/vision/camera/camera.hpp"

namespace microswarm::cli {

CameraParams camera_of(const std::string& rig) {
  if (rig.empty()) return {};
  const Rig read = read_rig(rig);
  if (const auto* camera = std::get_if<CameraParams>(&read.params.camera)) return *camera;
  return {};
}

Image picture_of(const std::string& source, CameraParams camera) {
  if (!is_camera(source)) return read_photograph(source);
  camera.device = source;
  NewestFrame live = live_camera(camera);
  LiveFrame frame;
  const double began = steady_seconds();
  while (live.wait(frame, 0.5) || steady_seconds() < began + 10)
    if (frame.frame.index > 0 && steady_seconds() > began + 1) return frame.frame.picture;
  throw HardwareError(source + ": no picture within 10 s");
}

}  // namespace microswarm::cli
