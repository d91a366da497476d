// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/v4l2_controls.hpp"

#include <linux/videodev2.h>

#include <cmath>
#include <cstdlib>
#include <string_view>

#include "microswarm/core/text/text.hpp"

namespace microswarm::vision {
namespace {

/// A setting that can be automatic or given.
struct Adjustable {
  std::string_view key;
  std::string_view noun;
  std::uint32_t id = 0;         ///< of its value
  std::uint32_t automatic = 0;  ///< of the switch to automatic
  bool is_menu = false;         ///< whether that switch is a menu, as for the exposure
  double steps = 1;             ///< camera's steps in one unit of the key
};

constexpr Adjustable exposure{.key = "exposure_ms",
                              .noun = "exposure time",
                              .id = V4L2_CID_EXPOSURE_ABSOLUTE,
                              .automatic = V4L2_CID_EXPOSURE_AUTO,
                              .is_menu = true,
                              .steps = 10};  // V4L2 counts in units of 100 µs
constexpr Adjustable gain{
    .key = "gain", .noun = "gain", .id = V4L2_CID_GAIN, .automatic = V4L2_CID_AUTOGAIN};
constexpr Adjustable white_balance{.key = "white_balance",
                                   .noun = "white balance",
                                   .id = V4L2_CID_WHITE_BALANCE_TEMPERATURE,
                                   .automatic = V4L2_CID_AUTO_WHITE_BALANCE};
constexpr Adjustable focus{.key = "focus",
                           .noun = "focus",
                           .id = V4L2_CID_FOCUS_ABSOLUTE,
                           .automatic = V4L2_CID_FOCUS_AUTO};

bool has(const V4l2Device& device, std::uint32_t id, v4l2_queryctrl& about) {
  about = {};
  about.id = id;
  return device.ask(VIDIOC_QUERYCTRL, &about) == 0 && (about.flags & V4L2_CTRL_FLAG_DISABLED) == 0;
}

bool set(const V4l2Device& device, std::uint32_t id, int value) {
  v4l2_control control{.id = id, .value = value};
  return device.ask(VIDIOC_S_CTRL, &control) == 0;
}

/// Makes the setting automatic, if the camera can.
void make_automatic(const V4l2Device& device, const Adjustable& what) {
  v4l2_queryctrl about;
  if (!has(device, what.automatic, about)) return;
  if (!what.is_menu)
    set(device, what.automatic, 1);
  else if (!set(device, what.automatic, V4L2_EXPOSURE_AUTO))
    set(device, what.automatic,
        V4L2_EXPOSURE_APERTURE_PRIORITY);  // UVC cameras' name for automatic
}

void make_manual(const V4l2Device& device, const Adjustable& what) {
  v4l2_queryctrl about;
  if (!has(device, what.automatic, about)) return;
  if (!set(device, what.automatic, what.is_menu ? V4L2_EXPOSURE_MANUAL : 0))
    device.fail("does not let its " + std::string(what.noun) + " be set by hand");
}

void adjust(const V4l2Device& device, const Adjustable& what, std::optional<double> wanted) {
  if (!wanted) return make_automatic(device, what);
  const std::string key(what.key);
  v4l2_queryctrl about;
  if (!has(device, what.id, about)) device.fail(key + ": it takes no " + std::string(what.noun));
  const auto value = static_cast<int>(std::lround(what.steps * *wanted));
  const auto text = [&](int v) { return number_text(v / what.steps); };
  if (value < about.minimum || value > about.maximum)
    device.fail(key + ": is " + number_text(*wanted) + ", it takes " + text(about.minimum) + ".." +
                text(about.maximum));
  make_manual(device, what);
  if (!set(device, what.id, value)) device.fail(key + ": it does not take " + text(value));
  v4l2_control control{.id = what.id, .value = 0};
  if (device.ask(VIDIOC_G_CTRL, &control) != 0) return;  // write-only
  // The camera may round to its next step.
  if (std::abs(control.value - value) >= std::max(about.step, 1))
    device.fail(key + ": it takes " + text(control.value) + " in place of " + text(value));
}

std::optional<double> to_number(std::optional<int> value) {
  if (value) return *value;
  return std::nullopt;
}

}  // namespace

void set_controls(const V4l2Device& device, const CameraParams& params) {
  adjust(device, exposure, params.exposure);
  adjust(device, gain, to_number(params.gain));
  adjust(device, white_balance, to_number(params.white_balance));
  adjust(device, focus, to_number(params.focus));
}

}  // namespace microswarm::vision
