// SPDX-License-Identifier: Apache-2.0
// Replaces genicam_device.cpp in a build without Aravis.
#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/camera/genicam_device.hpp"

namespace microswarm::vision {

std::unique_ptr<CameraDevice> open_genicam(const GenicamParams& params) {
  throw InputError("genicam:" + params.device +
                   ": this build has no GenICam cameras: install libaravis-dev and build with "
                   "MICROSWARM_ARAVIS=ON");
}

std::vector<ListedCamera> list_genicam_cameras() { return {}; }

bool has_genicam() { return false; }

}  // namespace microswarm::vision
