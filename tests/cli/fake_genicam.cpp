// SPDX-License-Identifier: Apache-2.0
// A GenICam camera that is not there. Loaded before Aravis (LD_PRELOAD), it lets the camera that
// Aravis itself simulates show our scene, and fail. FAKE_CAMERA says how: "unplug=20", see
// `Traits`.
#include <arv.h>
#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>

#include "tests/cli/fake_scene.hpp"

namespace {

using fake::number_of;

struct Traits {
  int unplug = number_of("unplug", -1);    // after so many pictures
  int stall = number_of("stall", -1);      // no more after so many
  int hang = number_of("hang", -1);        // Aravis does not come back
  int damaged = number_of("damaged", -1);  // all after so many have missing packets
  int every = number_of("every", 0);       // every so many is damaged
  int grow = number_of("grow", -1);        // another size than it was, after so many
  int busy = number_of("busy", 0);         // another program has it
  int controls = number_of("controls", 1);
  int step = number_of("step", 1);  // of the width
};

const Traits& traits() {
  static const Traits all;
  return all;
}

struct State {
  ArvDevice* device = nullptr;
  int pictures = 0;
};
State camera;

template <class F>
F* real(const char* name) {
  return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

bool is_after(int count) { return count >= 0 && camera.pictures >= count; }

/// A pixel of the format from grey.
std::size_t put(std::uint8_t* out, std::uint8_t grey, ArvPixelFormat format) {
  switch (format) {
    case ARV_PIXEL_FORMAT_RGB_8_PACKED:
      std::fill_n(out, 3, grey);
      return 3;
    case ARV_PIXEL_FORMAT_MONO_16:
      out[0] = 0;
      out[1] = grey;
      return 2;
    default:
      *out = grey;
      return 1;
  }
}

guint32 register_of(guint32 address) {
  guint32 value = 0;
  arv_fake_camera_read_register(arv_fake_device_get_fake_camera(ARV_FAKE_DEVICE(camera.device)),
                                address, &value);
  return value;
}

/// In place of Aravis's pattern.
void draw(ArvBuffer* buffer) {
  const ArvPixelFormat format = arv_buffer_get_image_pixel_format(buffer);
  const int width = arv_buffer_get_image_width(buffer);
  const int height = arv_buffer_get_image_height(buffer);
  size_t size = 0;
  auto* out = static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, &size)));
  const auto grey = fake::grey_picture(
      width, height, static_cast<int>(register_of(ARV_FAKE_CAMERA_REGISTER_GAIN_RAW)),
      camera.pictures);
  std::size_t at = 0;
  for (const std::uint8_t value : grey)
    if (at + 3 <= size + 2) at += put(out + at, value, format);
}

void change_size() {
  arv_fake_camera_write_register(arv_fake_device_get_fake_camera(ARV_FAKE_DEVICE(camera.device)),
                                 ARV_FAKE_CAMERA_REGISTER_HEIGHT,
                                 register_of(ARV_FAKE_CAMERA_REGISTER_HEIGHT) + 8);
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

ArvCamera* arv_camera_new(const char* name, GError** error) {
  if (traits().busy != 0) {
    g_set_error(error, ARV_DEVICE_ERROR, ARV_DEVICE_ERROR_TRANSFER_ERROR, "Failed to claim\nit");
    return nullptr;
  }
  ArvCamera* const made = real<decltype(arv_camera_new)>("arv_camera_new")(name, error);
  if (made) camera.device = arv_camera_get_device(made);
  return made;
}

ArvBuffer* arv_stream_timeout_pop_buffer(ArvStream* stream, guint64 timeout_us) {
  while (is_after(traits().hang)) sleep(1000);
  if (is_after(traits().unplug)) g_signal_emit_by_name(camera.device, "control-lost");
  if (is_after(traits().unplug) || is_after(traits().stall)) {
    usleep(static_cast<useconds_t>(timeout_us));
    return nullptr;
  }
  if (camera.pictures == traits().grow) change_size();
  ArvBuffer* const buffer = real<decltype(arv_stream_timeout_pop_buffer)>(
      "arv_stream_timeout_pop_buffer")(stream, timeout_us);
  if (!buffer) return buffer;
  if (real<decltype(arv_buffer_get_status)>("arv_buffer_get_status")(buffer) ==
          ARV_BUFFER_STATUS_SUCCESS &&
      ARV_IS_FAKE_DEVICE(camera.device))
    draw(buffer);
  ++camera.pictures;
  return buffer;
}

ArvBufferStatus arv_buffer_get_status(ArvBuffer* buffer) {
  const int n = camera.pictures - 1;
  if ((traits().damaged >= 0 && n >= traits().damaged) ||
      (traits().every > 0 && n % traits().every == 0))
    return ARV_BUFFER_STATUS_MISSING_PACKETS;
  return real<decltype(arv_buffer_get_status)>("arv_buffer_get_status")(buffer);
}

gboolean arv_camera_is_exposure_time_available(ArvCamera* made, GError** error) {
  return traits().controls != 0 && real<decltype(arv_camera_is_exposure_time_available)>(
                                       "arv_camera_is_exposure_time_available")(made, error) != 0;
}
gboolean arv_camera_is_gain_available(ArvCamera* made, GError** error) {
  return traits().controls != 0 && real<decltype(arv_camera_is_gain_available)>(
                                       "arv_camera_is_gain_available")(made, error) != 0;
}
gint arv_camera_get_width_increment(ArvCamera*, GError**) { return traits().step; }

}  // extern "C"
#pragma GCC visibility pop
