// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace microswarm::vision {

/// A picture format of a camera.
struct ListedFormat {
  std::string name{};
  bool readable = true;
  std::string
      sizes{};  ///< "640x480, 1280x720", "16x16..2048x2048"; empty if the camera reports none
};

/// A connected camera.
struct ListedCamera {
  std::string device{};  ///< as in commands: "/dev/video0", "genicam:ID"
  std::string model{};
  std::vector<ListedFormat> formats{};
  std::string trouble{};  ///< why it could not be queried; empty if it could
};

/// Lists the connected V4L2 and GenICam cameras. Takes about a second.
std::vector<ListedCamera> list_cameras();

}  // namespace microswarm::vision
