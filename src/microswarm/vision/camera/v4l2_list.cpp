// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/v4l2_list.hpp"
#include "microswarm/core/execution/descriptor.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "microswarm/core/text/text.hpp"
#include "microswarm/vision/camera/genicam_device.hpp"
#include "microswarm/vision/camera/v4l2_device.hpp"

namespace microswarm::vision {
namespace {

constexpr int max_devices = 256;           // kernel's limit
constexpr std::uint32_t max_entries = 64;  // against drivers whose list never ends

/// Error number of opening a device; 0 on success.
int error_of_opening(const std::string& name) {
  return open_descriptor(name, O_RDWR | O_NONBLOCK) ? 0 : errno;
}

bool is_absent(int error) { return error == ENOENT || error == ENXIO || error == ENODEV; }

std::string range_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::string list_sizes(const V4l2Device& device, std::uint32_t format) {
  std::string text;
  v4l2_frmsizeenum size{};
  size.pixel_format = format;
  for (; size.index < max_entries && device.ask(VIDIOC_ENUM_FRAMESIZES, &size) == 0; ++size.index) {
    const v4l2_frmsize_stepwise& range = size.stepwise;
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE)
      return range_text(range.min_width, range.min_height) + ".." +
             range_text(range.max_width, range.max_height);
    text += (text.empty() ? "" : ", ") + range_text(size.discrete.width, size.discrete.height);
  }
  return text;
}

std::vector<ListedFormat> list_formats(const V4l2Device& device) {
  std::vector<ListedFormat> formats;
  v4l2_fmtdesc offer{};
  offer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; offer.index < max_entries && device.ask(VIDIOC_ENUM_FMT, &offer) == 0; ++offer.index)
    formats.push_back({.name = fourcc_text(offer.pixelformat),
                       .readable = find_format(offer.pixelformat).has_value(),
                       .sizes = list_sizes(device, offer.pixelformat)});
  return formats;
}

std::string device_model(const V4l2Device& device) {
  v4l2_capability can{};
  if (device.ask(VIDIOC_QUERYCAP, &can) != 0) return {};
  const auto* card = reinterpret_cast<const char*>(can.card);
  return one_line({card, strnlen(card, sizeof can.card)});
}

}  // namespace

std::vector<ListedCamera> list_v4l2_cameras() {
  std::vector<ListedCamera> list;
  for (int i = 0; i < max_devices; ++i) {
    const std::string name = "/dev/video" + std::to_string(i);
    const int error = error_of_opening(name);
    if (is_absent(error)) continue;
    ListedCamera camera{.device = name, .model = {}, .formats = {}, .trouble = {}};
    if (error != 0) {
      camera.trouble = "cannot open: " + std::generic_category().message(error);
    } else {
      try {
        const V4l2Device device(name);
        camera.model = device_model(device);
        camera.formats = list_formats(device);
      } catch (const HardwareError&) {
        continue;  // a node without pictures, such as metadata
      }
    }
    list.push_back(std::move(camera));
  }
  return list;
}

std::vector<ListedCamera> list_cameras() {
  std::vector<ListedCamera> list = list_v4l2_cameras();
  for (ListedCamera& camera : list_genicam_cameras()) list.push_back(std::move(camera));
  return list;
}

}  // namespace microswarm::vision
