// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "microswarm/vision/camera/camera_device.hpp"
#include "microswarm/vision/camera/camera_list.hpp"
#include "microswarm/vision/camera/genicam_params.hpp"

namespace microswarm {

/// Opens a GenICam camera through Aravis and starts its stream. Finding it takes about a second.
/// Throws HardwareError "genicam:ID: WHY" when there is no such camera, it is in use, or it does
/// not take a setting; InputError when this build is without Aravis. While it is open, what Aravis
/// says by GLib's log is not printed.
std::unique_ptr<CameraDevice> open_genicam(const GenicamParams& params);

/// The GenICam cameras that are found on the networks and at USB, without simulated ones; none when
/// this build is without Aravis.
std::vector<ListedCamera> list_genicam_cameras();

/// What the module of Aravis does.
class GenicamCameras {
 public:
  virtual ~GenicamCameras() = default;
  /// As open_genicam.
  virtual std::unique_ptr<CameraDevice> open(const GenicamParams& params) const = 0;
  /// As list_genicam_cameras.
  virtual std::vector<ListedCamera> list() const = 0;
};

/// Whether this build can open GenICam cameras.
bool has_genicam();

}  // namespace microswarm
