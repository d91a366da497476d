// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "microswarm/vision/camera/camera_device.hpp"
#include "microswarm/vision/camera/camera_list.hpp"
#include "microswarm/vision/camera/genicam_params.hpp"

namespace microswarm::vision {

/// Opens a GenICam camera through Aravis and starts its stream. Finding it takes about a second.
/// Throws HardwareError "genicam:ID: WHY" if there is no such camera, it is in use or it refuses a
/// setting; InputError in a build without Aravis. While a camera is open, Aravis's messages in
/// GLib's log are suppressed.
std::unique_ptr<CameraDevice> open_genicam(const GenicamParams& params);

/// Lists the GenICam cameras on the networks and at USB, without simulated ones; none in a build
/// without Aravis.
std::vector<ListedCamera> list_genicam_cameras();

/// Interface of the module that is linked with Aravis.
class GenicamCameras {
 public:
  virtual ~GenicamCameras() = default;
  /// See open_genicam.
  virtual std::unique_ptr<CameraDevice> open(const GenicamParams& params) const = 0;
  /// See list_genicam_cameras.
  virtual std::vector<ListedCamera> list() const = 0;
};

/// Whether this build can open GenICam cameras.
bool has_genicam();

}  // namespace microswarm::vision
