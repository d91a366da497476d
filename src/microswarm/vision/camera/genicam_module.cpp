// SPDX-License-Identifier: Apache-2.0
// libmicroswarm_genicam.so, the only part that is linked with Aravis.
#include "microswarm/vision/camera/genicam_device.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/vision/camera/aravis.hpp"

namespace microswarm::vision {
namespace {

constexpr int buffers = 8;
constexpr double slice = 0.05;  // [s] between two checks for a lost camera during a wait

/// A device in Aravis's list.
struct FoundDevice {
  std::string id;
  std::string model;
};

std::vector<FoundDevice> found_devices() {
  arv_update_device_list();
  std::vector<FoundDevice> found;
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    if (to_text(arv_get_device_protocol(i)) == "Fake") continue;
    found.push_back(
        {.id = to_text(arv_get_device_id(i)),
         .model = to_text(arv_get_device_vendor(i)) + " " + to_text(arv_get_device_model(i))});
  }
  return found;
}

std::string to_list(const std::vector<FoundDevice>& devices) {
  std::string list;
  for (const FoundDevice& device : devices) list += (list.empty() ? "" : ", ") + device.id;
  return list.empty() ? "none" : list;
}
/// Id of the first camera found.
std::string first_id() {
  const std::vector<FoundDevice> found = found_devices();
  if (found.empty()) throw HardwareError("genicam: no GenICam camera was found");
  return found[0].id;
}

/// Opens a camera by its id, serial number or address.
Features open_features(const std::string& id, bool fake) {
  const std::string name = "genicam:" + id;
  Complaint complaint;
  if (fake) arv_enable_interface("Fake");
  Owned<ArvCamera> camera(arv_camera_new(id.c_str(), complaint.out()));
  if (fake) arv_disable_interface("Fake");
  if (!camera)
    throw HardwareError(name + ": cannot open: " + complaint.text() +
                        "; found: " + to_list(found_devices()));
  return {name, std::move(camera)};
}

const char* damage_text(ArvBufferStatus status) {
  switch (status) {
    case ARV_BUFFER_STATUS_SUCCESS:
      return "";
    case ARV_BUFFER_STATUS_TIMEOUT:
    case ARV_BUFFER_STATUS_MISSING_PACKETS:
    case ARV_BUFFER_STATUS_WRONG_PACKET_ID:
      return "packets are missing";
    case ARV_BUFFER_STATUS_SIZE_MISMATCH:
      return "it is larger than its size";
    default:
      return "it is incomplete";
  }
}

class GenicamDevice : public CameraDevice {
 public:
  GenicamDevice(const std::string& id, const GenicamParams& p)
      : CameraDevice("genicam:" + id), device_(open_features(id, is_fake(p))) {
    watch_control();
    apply(p, device_);
    rate_ = read_rate(device_, p.rate.has_value());
    start();
  }
  ~GenicamDevice() override {
    Complaint ignored;
    if (stream_ && !*lost_) arv_camera_stop_acquisition(device_.camera(), ignored.out());
    if (taken_) g_object_unref(taken_);
  }
  GenicamDevice(const GenicamDevice&) = delete;
  GenicamDevice& operator=(const GenicamDevice&) = delete;

  std::optional<double> rate() const override { return rate_; }

  std::optional<RawPicture> take(double seconds) override {
    if (taken_) arv_stream_push_buffer(stream_.get(), std::exchange(taken_, nullptr));
    const double end = steady_seconds() + seconds;
    for (;;) {
      if (*lost_) fail("was unplugged, or is lost to another program");
      const double left = std::clamp(end - steady_seconds(), 0.0, slice);
      taken_ = arv_stream_timeout_pop_buffer(stream_.get(), static_cast<guint64>(1e6 * left));
      if (taken_) return picture();
      if (left <= 0) return std::nullopt;
    }
  }

 private:
  using Flag = std::shared_ptr<std::atomic<bool>>;

  void watch_control() {
    ArvDevice* const device = arv_camera_get_device(device_.camera());
    if (ARV_IS_GV_DEVICE(device) && arv_gv_device_is_controller(ARV_GV_DEVICE(device)) == 0)
      fail("is in use by another program");
    // The signal arrives in a thread of Aravis, possibly during this object's destruction.
    g_signal_connect_data(
        device, "control-lost", reinterpret_cast<GCallback>(+[](ArvDevice*, gpointer lost) {
          **static_cast<Flag*>(lost) = true;
        }),
        new Flag(lost_), [](gpointer lost, GClosure*) { delete static_cast<Flag*>(lost); },
        static_cast<GConnectFlags>(0));
  }

  void start() {
    stream_.reset(device_.ask("stream", arv_camera_create_stream, nullptr, nullptr));
    if (!stream_) fail("gives no stream of pictures");
    const guint size = device_.ask("stream", arv_camera_get_payload);
    if (size == 0 || size > max_payload) fail("reports no picture size");
    for (int i = 0; i < buffers; ++i)
      arv_stream_push_buffer(stream_.get(), arv_buffer_new(size, nullptr));
    form_ = read_region(device_);
    if (form_.width <= 0 || form_.height <= 0 || form_.width > formats::max_image_side ||
        form_.height > formats::max_image_side)
      fail("gives pictures of " + to_text(form_) + " pixels");
    code_ = device_.ask("pixel_format", arv_camera_get_pixel_format);
    device_.ask("start", arv_camera_start_acquisition);
  }

  /// The data of the current buffer.
  RawPicture picture() const {
    RawPicture raw{.format = *to_pixel_format(code_),
                   .width = form_.width,
                   .height = form_.height,
                   .bytes_per_line = 0,
                   .bytes = {},
                   .damage = damage_text(arv_buffer_get_status(taken_))};
    if (!raw.damage.empty()) return raw;
    const ArvBufferPayloadType type = arv_buffer_get_payload_type(taken_);
    const bool is_picture =
        (type == ARV_BUFFER_PAYLOAD_TYPE_IMAGE ||
         type == ARV_BUFFER_PAYLOAD_TYPE_EXTENDED_CHUNK_DATA) &&
        arv_buffer_get_n_parts(taken_) > 0 &&
        arv_buffer_get_part_data_type(taken_, 0) == ARV_BUFFER_PART_DATA_TYPE_2D_IMAGE;
    if (!is_picture) {
      raw.damage = "it is no uncompressed picture";
      return raw;
    }
    if (arv_buffer_get_image_width(taken_) != form_.width ||
        arv_buffer_get_image_height(taken_) != form_.height ||
        arv_buffer_get_image_pixel_format(taken_) != code_) {
      raw.damage = "it has another size or format";
      return raw;
    }
    gint gap = 0;
    gint rows = 0;
    arv_buffer_get_image_padding(taken_, &gap, &rows);
    std::size_t size = 0;
    const void* const data = arv_buffer_get_image_data(taken_, &size);
    raw.bytes = {static_cast<const std::byte*>(data), data ? size : 0};
    if (gap > 0)
      raw.bytes_per_line =
          static_cast<std::size_t>(form_.width) * (ARV_PIXEL_FORMAT_BIT_PER_PIXEL(code_) / 8) +
          static_cast<std::size_t>(gap);
    return raw;
  }

  static constexpr guint max_payload = 1U << 30;

  QuietLog quiet_;
  Features device_;
  Flag lost_ = std::make_shared<std::atomic<bool>>(false);
  Owned<ArvStream> stream_;
  ArvBuffer* taken_ = nullptr;
  Region form_;
  ArvPixelFormat code_ = 0;
  std::optional<double> rate_;
};
ListedCamera listed(const FoundDevice& found) {
  ListedCamera camera{
      .device = "genicam:" + found.id, .model = found.model, .formats = {}, .trouble = {}};
  try {
    const Features device = open_features(found.id, false);
    const std::string sizes = offered_sizes(device);
    const std::vector<ArvPixelFormat> codes = offered_codes(device);
    const std::vector<std::string> names = offered_names(device);
    for (std::size_t i = 0; i < std::min(codes.size(), names.size()); ++i)
      camera.formats.push_back({names[i], to_pixel_format(codes[i]).has_value(), sizes});
  } catch (const HardwareError& error) {
    camera.trouble = error.what();
  }
  return camera;
}

class AravisCameras : public GenicamCameras {
 public:
  std::unique_ptr<CameraDevice> open(const GenicamParams& params) const override {
    const QuietLog quiet;
    return std::make_unique<GenicamDevice>(params.device.empty() ? first_id() : params.device,
                                           params);
  }

  std::vector<ListedCamera> list() const override {
    const QuietLog quiet;
    std::vector<ListedCamera> list;
    for (const FoundDevice& found : found_devices()) list.push_back(listed(found));
    return list;
  }
};

}  // namespace
}  // namespace microswarm::vision

/// Symbol that open_genicam looks up.
extern "C" const microswarm::vision::GenicamCameras* microswarm_genicam() {
  static const microswarm::vision::AravisCameras only;
  return &only;
}
