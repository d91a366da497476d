// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/genicam_device.hpp"

#include "microswarm/core/execution/module.hpp"

namespace microswarm::vision {
namespace {

const GenicamCameras& cameras() {
  static const GenicamCameras& loaded =
      *reinterpret_cast<const GenicamCameras* (*)()>(load_module("genicam", "GenICam cameras"))();
  return loaded;
}

}  // namespace

std::unique_ptr<CameraDevice> open_genicam(const GenicamParams& params) {
  return cameras().open(params);
}

std::vector<ListedCamera> list_genicam_cameras() { return cameras().list(); }

bool has_genicam() { return true; }

}  // namespace microswarm::vision
