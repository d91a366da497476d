// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace microswarm {

/// A format in which a camera gives pictures.
struct ListedFormat {
  std::string name;
  bool readable = true;
  std::string sizes;  ///< "640x480, 1280x720", "16x16..2048x2048"; empty if the camera tells none
};

/// A camera that is there.
struct ListedCamera {
  std::string device;  ///< as commands take it: "/dev/video0", "genicam:ID"
  std::string model;
  std::vector<ListedFormat> formats;
  std::string trouble;  ///< why it could not be asked; empty if it could
};

/// The cameras of V4L2 and GenICam that are there. Takes about a second.
std::vector<ListedCamera> list_cameras();

}  // namespace microswarm
