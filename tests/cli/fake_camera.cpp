// SPDX-License-Identifier: Apache-2.0
// A camera of V4L2 that is not there. Loaded before the C library (LD_PRELOAD), it answers open,
// ioctl, mmap, poll and close of one device; all else goes to the kernel. FAKE_CAMERA says how it
// is: "device=/dev/video90 unplug=20", see `Traits`.
#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <turbojpeg.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/cli/fake_scene.hpp"

namespace {

using fake::number_of;
using fake::word_of;

struct Traits {
  std::string device = word_of("device", "");
  std::string formats = word_of("formats", "YUYV,GREY,MJPG");  // the first is set at first
  int width = number_of("width", 0);                           // the only size that it has; 0: any
  int height = number_of("height", 0);
  int rate = number_of("rate", 50);
  int unplug = number_of("unplug", -1);    // after so many pictures
  int stall = number_of("stall", -1);      // no more after so many
  int hang = number_of("hang", -1);        // the driver does not come back
  int damaged = number_of("damaged", -1);  // all after so many
  int every = number_of("every", 0);       // every so many is damaged
  int busy = number_of("busy", 0);         // another program has it
  int no_camera = number_of("no_camera", 0);
  int output = number_of("output", 0);  // it shows pictures
  int controls = number_of("controls", 1);
  int region = number_of("region", 0);  // it has one, in steps of 8
};

const Traits& traits() {
  static const Traits all;
  return all;
}

struct Control {
  std::uint32_t id;
  int min, max, step, value;
  std::uint32_t automatic;  // 0: always by hand
};

struct State {
  int file = -1;
  v4l2_pix_format form{};
  v4l2_rect region{0, 0, 1280, 960};
  std::vector<Control> controls{
      {V4L2_CID_EXPOSURE_AUTO, 0, 3, 1, 3, 0},
      {V4L2_CID_EXPOSURE_ABSOLUTE, 3, 2047, 1, 100, V4L2_CID_EXPOSURE_AUTO},
      {V4L2_CID_GAIN, 0, 100, 1, 0, 0},
      {V4L2_CID_AUTO_WHITE_BALANCE, 0, 1, 1, 1, 0},
      {V4L2_CID_WHITE_BALANCE_TEMPERATURE, 2800, 6500, 10, 4000, V4L2_CID_AUTO_WHITE_BALANCE}};
  std::vector<std::uint8_t*> memory;
  std::vector<int> queued;
  int pictures = 0;
  double began = 0;
};
State camera;

constexpr std::uint32_t memory_size = 1 << 22;

double now() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

bool is_device(const char* path) {
  return path && !traits().device.empty() && traits().device == path;
}

int refuse(int error) {
  errno = error;
  return -1;
}

std::uint32_t code(const std::string& name) {
  return v4l2_fourcc(name[0], name[1], name[2], name[3]);
}
std::vector<std::uint32_t> formats() {
  std::vector<std::uint32_t> all;
  const std::string& text = traits().formats;
  for (std::size_t at = 0; at + 4 <= text.size(); at += 5) all.push_back(code(text.substr(at, 4)));
  return all;
}

Control* control_of(std::uint32_t id) {
  if (traits().controls == 0) return nullptr;
  for (Control& c : camera.controls)
    if (c.id == id) return &c;
  return nullptr;
}

/// Grey 120, brighter by the gain, with a dark disc; or the scene.
std::vector<std::uint8_t> grey_picture() {
  const int gain = control_of(V4L2_CID_GAIN) ? control_of(V4L2_CID_GAIN)->value : 0;
  return fake::grey_picture(static_cast<int>(camera.form.width),
                            static_cast<int>(camera.form.height), gain, camera.pictures);
}

/// Writes a picture; how many bytes it has.
std::uint32_t draw(std::uint8_t* out) {
  const std::vector<std::uint8_t> grey = grey_picture();
  const int width = static_cast<int>(camera.form.width);
  const int height = static_cast<int>(camera.form.height);
  if (camera.form.pixelformat == V4L2_PIX_FMT_MJPEG) {
    const tjhandle jpeg = tjInitCompress();
    unsigned long size = memory_size;
    tjCompress2(jpeg, grey.data(), width, 0, height, TJPF_GRAY, &out, &size, TJSAMP_GRAY, 90,
                TJFLAG_NOREALLOC);
    tjDestroy(jpeg);
    return static_cast<std::uint32_t>(size);
  }
  if (camera.form.pixelformat != V4L2_PIX_FMT_YUYV) {
    std::copy(grey.begin(), grey.end(), out);
    return static_cast<std::uint32_t>(grey.size());
  }
  for (std::size_t i = 0; i < grey.size(); ++i) {
    out[2 * i] = static_cast<std::uint8_t>(16 + grey[i] * 219 / 255);
    out[2 * i + 1] = 128;
  }
  return static_cast<std::uint32_t>(2 * grey.size());
}

int set_format(v4l2_format& form) {
  if (traits().busy) return refuse(EBUSY);
  v4l2_pix_format& pix = form.fmt.pix;
  const auto known = formats();
  if (std::find(known.begin(), known.end(), pix.pixelformat) == known.end())
    pix.pixelformat = known[0];  // as drivers do
  if (traits().width > 0) {
    pix.width = static_cast<std::uint32_t>(traits().width);
    pix.height = static_cast<std::uint32_t>(traits().height);
  }
  const bool yuyv = pix.pixelformat == V4L2_PIX_FMT_YUYV;
  pix.bytesperline = pix.pixelformat == V4L2_PIX_FMT_MJPEG ? 0 : pix.width * (yuyv ? 2 : 1);
  pix.sizeimage = memory_size;
  camera.form = pix;
  return 0;
}

int set_control(v4l2_control& control) {
  Control* const c = control_of(control.id);
  if (!c) return refuse(EINVAL);
  if (c->id == V4L2_CID_EXPOSURE_AUTO && control.value != V4L2_EXPOSURE_MANUAL &&
      control.value != V4L2_EXPOSURE_APERTURE_PRIORITY)
    return refuse(EINVAL);  // as UVC cameras
  if (c->automatic != 0) {
    const int by_hand = c->automatic == V4L2_CID_EXPOSURE_AUTO ? V4L2_EXPOSURE_MANUAL : 0;
    if (control_of(c->automatic)->value != by_hand) return refuse(EACCES);
  }
  if (control.value < c->min || control.value > c->max) return refuse(ERANGE);
  c->value = control.value / c->step * c->step;
  control.value = c->value;
  return 0;
}

bool is_unplugged() { return traits().unplug >= 0 && camera.pictures >= traits().unplug; }

int dequeue(v4l2_buffer& buffer) {
  if (is_unplugged()) return refuse(ENODEV);
  while (traits().hang >= 0 && camera.pictures >= traits().hang) sleep(1000);
  if (camera.queued.empty()) return refuse(EAGAIN);
  const int index = camera.queued.front();
  camera.queued.erase(camera.queued.begin());
  buffer.index = static_cast<std::uint32_t>(index);
  buffer.bytesused = draw(camera.memory[static_cast<std::size_t>(index)]);
  const int n = camera.pictures++;
  if ((traits().damaged >= 0 && n >= traits().damaged) ||
      (traits().every > 0 && n % traits().every == 0))
    buffer.bytesused /= 2;
  return 0;
}

int ask_control(v4l2_queryctrl& about) {
  const Control* const c = control_of(about.id);
  if (!c) return refuse(EINVAL);
  about.minimum = c->min;
  about.maximum = c->max;
  about.step = c->step;
  return 0;
}

int select_region(v4l2_selection& selection) {
  if (!traits().region) return refuse(ENOTTY);
  selection.r.left -= selection.r.left % 8;
  selection.r.top -= selection.r.top % 8;
  camera.region = selection.r;
  return 0;
}

int answer(unsigned long request, void* p) {
  switch (request) {
    case VIDIOC_QUERYCAP: {
      if (traits().no_camera) return refuse(ENOTTY);
      auto& can = *static_cast<v4l2_capability*>(p);
      std::strcpy(reinterpret_cast<char*>(can.card), "a \033fake camera");
      can.capabilities = V4L2_CAP_DEVICE_CAPS;
      can.device_caps =
          (traits().output ? V4L2_CAP_VIDEO_OUTPUT : V4L2_CAP_VIDEO_CAPTURE) | V4L2_CAP_STREAMING;
      return 0;
    }
    case VIDIOC_ENUM_FMT: {
      auto& offer = *static_cast<v4l2_fmtdesc*>(p);
      const auto known = formats();
      if (offer.index >= known.size()) return refuse(EINVAL);
      offer.pixelformat = known[offer.index];
      return 0;
    }
    case VIDIOC_ENUM_FRAMESIZES: {
      auto& size = *static_cast<v4l2_frmsizeenum*>(p);
      if (size.index >= 2) return refuse(EINVAL);
      size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
      size.discrete.width = 320 * (size.index + 1);
      size.discrete.height = 240 * (size.index + 1);
      return 0;
    }
    case VIDIOC_G_FMT:
      camera.form.pixelformat = formats()[0];
      static_cast<v4l2_format*>(p)->fmt.pix = camera.form;
      return 0;
    case VIDIOC_S_FMT:
      return set_format(*static_cast<v4l2_format*>(p));
    case VIDIOC_G_PARM:
    case VIDIOC_S_PARM: {
      auto& capture = static_cast<v4l2_streamparm*>(p)->parm.capture;
      capture.capability = V4L2_CAP_TIMEPERFRAME;
      capture.timeperframe = {1, static_cast<std::uint32_t>(traits().rate)};
      return 0;
    }
    case VIDIOC_S_SELECTION:
      return select_region(*static_cast<v4l2_selection*>(p));
    case VIDIOC_G_SELECTION:
      static_cast<v4l2_selection*>(p)->r = camera.region;
      return 0;
    case VIDIOC_QUERYCTRL:
      return ask_control(*static_cast<v4l2_queryctrl*>(p));
    case VIDIOC_S_CTRL:
      return set_control(*static_cast<v4l2_control*>(p));
    case VIDIOC_G_CTRL: {
      auto& control = *static_cast<v4l2_control*>(p);
      const Control* const c = control_of(control.id);
      if (!c) return refuse(EINVAL);
      control.value = c->value;
      return 0;
    }
    case VIDIOC_REQBUFS:
      camera.memory.resize(static_cast<v4l2_requestbuffers*>(p)->count);
      return 0;
    case VIDIOC_QUERYBUF: {
      auto& buffer = *static_cast<v4l2_buffer*>(p);
      buffer.length = memory_size;
      buffer.m.offset = buffer.index * memory_size;
      return 0;
    }
    case VIDIOC_QBUF:
      if (is_unplugged()) return refuse(ENODEV);
      camera.queued.push_back(static_cast<int>(static_cast<v4l2_buffer*>(p)->index));
      return 0;
    case VIDIOC_DQBUF:
      return dequeue(*static_cast<v4l2_buffer*>(p));
    case VIDIOC_STREAMON:
      camera.began = now();
      return 0;
    case VIDIOC_STREAMOFF:
      return 0;
    default:
      return refuse(ENOTTY);
  }
}

void rest(double seconds) {
  const auto us = static_cast<std::int64_t>(1e6 * seconds);
  if (us > 0) usleep(static_cast<useconds_t>(us));
}

int wait_for_picture(pollfd& ready, int timeout_ms) {
  if (is_unplugged()) {
    ready.revents = POLLERR | POLLHUP;
    return 1;
  }
  const double due = camera.began + (camera.pictures + 1.0) / traits().rate - now();
  const bool stalls = traits().stall >= 0 && camera.pictures >= traits().stall;
  if (stalls || (timeout_ms >= 0 && due > 1e-3 * timeout_ms)) {
    rest(1e-3 * timeout_ms);
    return 0;
  }
  rest(due);
  ready.revents = POLLIN;
  return 1;
}

void* map_memory(void* at, std::size_t length, int protection, int flags, int file, off_t offset) {
  const bool ours = file >= 0 && file == camera.file;
  if (ours) flags = MAP_SHARED | MAP_ANONYMOUS;
  const auto made =
      syscall(SYS_mmap, at, length, protection, flags, ours ? -1 : file, ours ? 0 : offset);
  void* const memory = reinterpret_cast<void*>(made);
  if (ours && memory != MAP_FAILED)
    camera.memory[static_cast<std::size_t>(offset) / memory_size] =
        static_cast<std::uint8_t*>(memory);
  return memory;
}

int open_file(const char* path, int flags, unsigned mode) {
  const bool ours = is_device(path);
  const auto file =
      static_cast<int>(syscall(SYS_openat, AT_FDCWD, ours ? "/dev/null" : path, flags, mode));
  if (ours) camera.file = file;
  return file;
}

}  // namespace

#pragma GCC visibility push(default)
// The C library declares that poll only writes to its first argument.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const auto mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, unsigned) : 0;
  va_end(more);
  return open_file(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const auto mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, unsigned) : 0;
  va_end(more);
  return open_file(path, flags, mode);
}
int close(int file) {
  if (file >= 0 && file == camera.file) camera.file = -1;
  return static_cast<int>(syscall(SYS_close, file));
}
int ioctl(int file, unsigned long request, ...) {
  va_list more;
  va_start(more, request);
  void* const argument = va_arg(more, void*);
  va_end(more);
  if (file >= 0 && file == camera.file) return answer(request, argument);
  return static_cast<int>(syscall(SYS_ioctl, file, request, argument));
}
int poll(pollfd* files, nfds_t count, int timeout_ms) {
  if (count == 1 && files->fd >= 0 && files->fd == camera.file)
    return wait_for_picture(*files, timeout_ms);
  return static_cast<int>(syscall(SYS_poll, files, count, timeout_ms));
}
void* mmap(void* at, std::size_t length, int protection, int flags, int file, off_t offset) {
  return map_memory(at, length, protection, flags, file, offset);
}
void* mmap64(void* at, std::size_t length, int protection, int flags, int file, off_t offset) {
  return map_memory(at, length, protection, flags, file, offset);
}

}  // extern "C"
#pragma GCC visibility pop
