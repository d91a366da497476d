// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/v4l2_device.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/fields/fields.hpp"

namespace microswarm::vision {
namespace {

constexpr std::uint32_t wanted_buffers = 4;
constexpr std::uint32_t max_formats = 64;  // against drivers whose list never ends

std::string reason(int error) {
  if (error == EBUSY) return "it is in use by another program";
  return std::generic_category().message(error);
}

bool is_gone(int error) { return error == ENODEV || error == ENXIO; }

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::string region_text(const v4l2_rect& r) {
  return size_text(static_cast<int>(r.width), static_cast<int>(r.height)) + " at " +
         std::to_string(r.left) + "," + std::to_string(r.top);
}

}  // namespace

V4l2Device::V4l2Device(std::string name)
    : CameraDevice(std::move(name)), file_(open_descriptor(this->name(), O_RDWR | O_NONBLOCK)) {
  if (!file_) fail("cannot open: " + reason(errno));
  struct stat about {};
  if (::fstat(file_.get(), &about) != 0 || !S_ISCHR(about.st_mode)) fail("is no camera");
  v4l2_capability can{};
  if (ask(VIDIOC_QUERYCAP, &can) != 0) fail("is no camera that can be opened");
  const std::uint32_t kinds =
      (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
  if ((kinds & V4L2_CAP_VIDEO_CAPTURE) == 0) fail("is no camera that gives pictures");
  if ((kinds & V4L2_CAP_STREAMING) == 0) fail("gives no stream of pictures");
}

V4l2Device::~V4l2Device() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (!buffers_.empty()) ask(VIDIOC_STREAMOFF, &type);
  for (const auto& buffer : buffers_) ::munmap(buffer.data(), buffer.size());
}

int V4l2Device::ask(unsigned long request, void* argument) const {
  int result = 0;
  do result = ::ioctl(file_.get(), request, argument);
  while (result < 0 && errno == EINTR);
  return result < 0 ? errno : 0;
}

void V4l2Device::set_region(const SensorRegion& region) {
  v4l2_selection selection{};
  selection.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  selection.target = V4L2_SEL_TGT_CROP;
  selection.r = {.left = region.x,
                 .top = region.y,
                 .width = static_cast<std::uint32_t>(region.width),
                 .height = static_cast<std::uint32_t>(region.height)};
  const v4l2_rect wanted = selection.r;
  if (const int error = ask(VIDIOC_S_SELECTION, &selection); error != 0)
    fail(error == EBUSY ? reason(error) : "takes no region of its sensor");
  ask(VIDIOC_G_SELECTION, &selection);
  const v4l2_rect& has = selection.r;
  if (has.left != wanted.left || has.top != wanted.top || has.width != wanted.width ||
      has.height != wanted.height)
    fail("reads the region " + region_text(has) + ", asked for was " + region_text(wanted));
}

std::string V4l2Device::offered_formats() const {
  std::string list;
  v4l2_fmtdesc offer{};
  offer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; offer.index < max_formats && ask(VIDIOC_ENUM_FMT, &offer) == 0; ++offer.index)
    list += (list.empty() ? "" : ", ") + fourcc_text(offer.pixelformat);
  return list.empty() ? "none" : list;
}

void V4l2Device::fail_format(std::uint32_t wanted) const {
  fail("gives no pictures in the format " + fourcc_text(wanted) +
       ", its formats are: " + offered_formats());
}

PixelFormat V4l2Device::readable(std::uint32_t fourcc) const {
  if (const auto format = find_format(fourcc)) return *format;
  fail("gives pictures in the format " + fourcc_text(fourcc) +
       ", which is not read, see pixel_format; its formats are: " + offered_formats());
}

void V4l2Device::set_format(std::optional<PixelFormat> format, int width, int height) {
  v4l2_format form{};
  form.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int error = ask(VIDIOC_G_FMT, &form); error != 0)
    fail("reports no picture format: " + reason(error));
  v4l2_pix_format& pix = form.fmt.pix;
  const std::uint32_t wanted = format ? to_fourcc(*format) : pix.pixelformat;
  readable(wanted);
  pix = {};
  pix.width = static_cast<std::uint32_t>(width);
  pix.height = static_cast<std::uint32_t>(height);
  pix.pixelformat = wanted;
  pix.field = V4L2_FIELD_ANY;
  if (const int error = ask(VIDIOC_S_FMT, &form); error == EINVAL)
    fail_format(wanted);
  else if (error != 0)
    fail("takes no format: " + reason(error));
  if (pix.pixelformat != wanted) fail_format(wanted);
  form_ = {.format = readable(pix.pixelformat),
           .width = static_cast<int>(pix.width),
           .height = static_cast<int>(pix.height),
           .bytes_per_line = pix.bytesperline};
  if (form_.width != width || form_.height != height)
    fail("gives pictures of " + size_text(form_.width, form_.height) + " pixels, asked for were " +
         size_text(width, height));
}

void V4l2Device::set_rate(double rate) {
  rate_.reset();
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_captureparm& capture = parameters.parm.capture;
  if (ask(VIDIOC_G_PARM, &parameters) != 0) return;
  if ((capture.capability & V4L2_CAP_TIMEPERFRAME) != 0) {
    capture.timeperframe = {.numerator = 1000,
                            .denominator = static_cast<std::uint32_t>(std::lround(1000 * rate))};
    if (ask(VIDIOC_S_PARM, &parameters) != 0) return;
  }
  const v4l2_fract& time = capture.timeperframe;
  if (time.numerator > 0 && time.denominator > 0)
    rate_ = static_cast<double>(time.denominator) / time.numerator;
}

void V4l2Device::start() {
  v4l2_requestbuffers request{};
  request.count = wanted_buffers;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (const int error = ask(VIDIOC_REQBUFS, &request); error != 0)
    fail("gives no memory for pictures: " + reason(error));
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer{};
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = i;
    if (const int error = ask(VIDIOC_QUERYBUF, &buffer); error != 0)
      fail("gives no memory for pictures: " + reason(error));
    void* const memory = ::mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED,
                                file_.get(), static_cast<off_t>(buffer.m.offset));
    if (memory == MAP_FAILED) fail("gives no memory for pictures: " + reason(errno));
    buffers_.emplace_back(static_cast<std::byte*>(memory), buffer.length);
    enqueue(i);
  }
  if (buffers_.empty()) fail("gives no memory for pictures");
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int error = ask(VIDIOC_STREAMON, &type); error != 0)
    fail("cannot start: " +
         (error == ENOSPC ? "its bus is too slow for this size and rate" : reason(error)));
}

void V4l2Device::enqueue(std::uint32_t index) const {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  const int error = ask(VIDIOC_QBUF, &buffer);
  if (is_gone(error)) fail("was unplugged");
  if (error != 0) fail("takes no memory for pictures: " + reason(error));
}

/// Whether the device becomes readable within `seconds`.
bool V4l2Device::wait(double seconds) const {
  const double end = steady_seconds() + seconds;
  for (;;) {
    pollfd ready{.fd = file_.get(), .events = POLLIN, .revents = 0};
    const double left = std::clamp(end - steady_seconds(), 0.0, 1e6);
    const int count = ::poll(&ready, 1, static_cast<int>(std::ceil(1e3 * left)));
    if (count > 0) return true;
    if (count == 0) return false;
    if (errno != EINTR) fail("cannot be waited for: " + reason(errno));
  }
}

std::optional<RawPicture> V4l2Device::take(double seconds) {
  if (taken_) enqueue(*std::exchange(taken_, std::nullopt));
  if (!wait(seconds)) return std::nullopt;
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  const int error = ask(VIDIOC_DQBUF, &buffer);
  if (is_gone(error)) fail("was unplugged");
  if (error == EAGAIN) fail("gives no more pictures");  // readable, but without a picture
  if (error != 0) fail("gives no more pictures: " + reason(error));
  if (buffer.index >= buffers_.size()) fail("gives pictures where it has no memory for them");
  taken_ = buffer.index;
  RawPicture raw = form_;
  const std::span<std::byte> memory = buffers_[buffer.index];
  if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0)
    raw.damage = "the driver calls it damaged";
  else
    raw.bytes = memory.first(std::min<std::size_t>(buffer.bytesused, memory.size()));
  return raw;
}

}  // namespace microswarm::vision
