// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/genicam_device.hpp"

#include <arv.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <type_traits>
#include <utility>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

constexpr int buffers = 8;
constexpr double slice = 0.05;      // [s] of a wait, between looks at whether the camera is lost
constexpr double tolerance = 0.05;  // relative, of a value that the camera rounds

struct Release {
  void operator()(gpointer object) const { g_object_unref(object); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

/// Keeps GLib's log of Aravis, which has no domain, away from the terminal.
class QuietLog {
 public:
  QuietLog()
      : handler_(g_log_set_handler(
            nullptr, static_cast<GLogLevelFlags>(G_LOG_LEVEL_MASK | G_LOG_FLAG_RECURSION),
            [](const gchar*, GLogLevelFlags, const gchar*, gpointer) {}, nullptr)) {}
  ~QuietLog() { g_log_remove_handler(nullptr, handler_); }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;

 private:
  guint handler_;
};

/// What Aravis complains of in one call.
class Complaint {
 public:
  Complaint() = default;
  ~Complaint() { g_clear_error(&error_); }
  Complaint(const Complaint&) = delete;
  Complaint& operator=(const Complaint&) = delete;
  GError** out() { return &error_; }
  explicit operator bool() const { return error_ != nullptr; }
  std::string text() const { return error_ ? one_line(error_->message) : "no reason is told"; }

 private:
  GError* error_ = nullptr;
};

/// A format of ours, of Aravis, and of the data.
struct KnownFormat {
  GenicamFormat format;
  ArvPixelFormat code;
  PixelFormat data;
};
constexpr KnownFormat known_formats[] = {
    {GenicamFormat::mono8, ARV_PIXEL_FORMAT_MONO_8, PixelFormat::grey},
    {GenicamFormat::mono10, ARV_PIXEL_FORMAT_MONO_10, PixelFormat::y10},
    {GenicamFormat::mono12, ARV_PIXEL_FORMAT_MONO_12, PixelFormat::y12},
    {GenicamFormat::mono16, ARV_PIXEL_FORMAT_MONO_16, PixelFormat::y16},
    {GenicamFormat::bayer_rg8, ARV_PIXEL_FORMAT_BAYER_RG_8, PixelFormat::rggb},
    {GenicamFormat::bayer_gr8, ARV_PIXEL_FORMAT_BAYER_GR_8, PixelFormat::grbg},
    {GenicamFormat::bayer_gb8, ARV_PIXEL_FORMAT_BAYER_GB_8, PixelFormat::gbrg},
    {GenicamFormat::bayer_bg8, ARV_PIXEL_FORMAT_BAYER_BG_8, PixelFormat::bggr},
    {GenicamFormat::rgb8, ARV_PIXEL_FORMAT_RGB_8_PACKED, PixelFormat::rgb3},
    {GenicamFormat::bgr8, ARV_PIXEL_FORMAT_BGR_8_PACKED, PixelFormat::bgr3},
    {GenicamFormat::yuv422_8, ARV_PIXEL_FORMAT_YUV_422_YUYV_PACKED, PixelFormat::yuyv},
    {GenicamFormat::yuv422_8_uyvy, ARV_PIXEL_FORMAT_YUV_422_PACKED, PixelFormat::uyvy}};

const KnownFormat* known(ArvPixelFormat code) {
  const auto* found = std::ranges::find(known_formats, code, &KnownFormat::code);
  return found == std::end(known_formats) ? nullptr : found;
}
const KnownFormat& known(GenicamFormat format) {
  return *std::ranges::find(known_formats, format, &KnownFormat::format);
}

std::string text_of(const char* text) { return text ? one_line(text) : ""; }

std::string size_text(int columns, int rows) {
  return std::to_string(columns) + "x" + std::to_string(rows);
}

/// A device of Aravis's list.
struct FoundDevice {
  std::string id;
  std::string model;
};

std::vector<FoundDevice> found_devices() {
  arv_update_device_list();
  std::vector<FoundDevice> found;
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    if (text_of(arv_get_device_protocol(i)) == "Fake") continue;
    found.push_back(
        {.id = text_of(arv_get_device_id(i)),
         .model = text_of(arv_get_device_vendor(i)) + " " + text_of(arv_get_device_model(i))});
  }
  return found;
}

std::string list_of(const std::vector<FoundDevice>& devices) {
  std::string list;
  for (const FoundDevice& device : devices) list += (list.empty() ? "" : ", ") + device.id;
  return list.empty() ? "none" : list;
}

/// A device with its features, of which a caller may be told what is wrong.
class Features {
 public:
  Features(std::string name, Owned<ArvCamera> camera)
      : name_(std::move(name)), camera_(std::move(camera)) {}

  ArvCamera* camera() const { return camera_.get(); }
  [[noreturn]] void fail(const std::string& why) const { throw HardwareError(name_ + ": " + why); }

  /// Calls a function of Aravis, whose last argument is the place for a complaint.
  template <class F, class... Arguments>
  auto ask(const char* what, F function, Arguments... arguments) const {
    Complaint complaint;
    const auto check = [&] {
      if (complaint) fail(std::string(what) + ": " + complaint.text());
    };
    if constexpr (std::is_void_v<decltype(function(camera(), arguments..., complaint.out()))>) {
      function(camera(), arguments..., complaint.out());
      check();
    } else {
      const auto result = function(camera(), arguments..., complaint.out());
      check();
      return result;
    }
  }
  bool has(const char* feature) const {
    Complaint complaint;
    return arv_camera_is_feature_available(camera(), feature, complaint.out()) != 0;
  }

 private:
  std::string name_;
  Owned<ArvCamera> camera_;
};

std::vector<ArvPixelFormat> offered_codes(const Features& device) {
  guint count = 0;
  Complaint complaint;
  gint64* const codes =
      arv_camera_dup_available_pixel_formats(device.camera(), &count, complaint.out());
  std::vector<ArvPixelFormat> offered;
  for (guint i = 0; codes && i < count; ++i)
    offered.push_back(static_cast<ArvPixelFormat>(codes[i]));
  g_free(codes);
  return offered;
}

std::vector<std::string> offered_names(const Features& device) {
  guint count = 0;
  Complaint complaint;
  const char** const names =
      arv_camera_dup_available_pixel_formats_as_strings(device.camera(), &count, complaint.out());
  std::vector<std::string> offered;
  for (guint i = 0; names && i < count; ++i) offered.push_back(text_of(names[i]));
  g_free(names);
  return offered;
}

std::string offered_formats(const Features& device) {
  std::string list;
  for (const std::string& name : offered_names(device)) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

void set_format(const Features& device, std::optional<GenicamFormat> wanted) {
  constexpr const char* key = "pixel_format";
  if (wanted) {
    const ArvPixelFormat code = known(*wanted).code;
    const std::vector<ArvPixelFormat> offered = offered_codes(device);
    if (std::ranges::find(offered, code) == offered.end())
      device.fail("gives no pictures in the format " + std::string(enum_name(*wanted)) +
                  ", its formats are: " + offered_formats(device));
    device.ask(key, arv_camera_set_pixel_format, code);
  }
  const ArvPixelFormat has = device.ask(key, arv_camera_get_pixel_format);
  if (wanted && has != known(*wanted).code)
    device.fail("does not take the format " + std::string(enum_name(*wanted)));
  if (!known(has))
    device.fail(
        "gives pictures in the format " +
        text_of(device.ask(key, arv_camera_get_pixel_format_as_string)) +
        ", which is not read: set pixel_format to one of its others: " + offered_formats(device));
}

/// A whole number of the camera and what it takes.
struct Measure {
  const char* key;
  void (*bounds)(ArvCamera*, gint*, gint*, GError**);
  gint (*step)(ArvCamera*, GError**);
};
constexpr Measure width_limits{"width_px", arv_camera_get_width_bounds,
                               arv_camera_get_width_increment};
constexpr Measure height_limits{"height_px", arv_camera_get_height_bounds,
                                arv_camera_get_height_increment};
constexpr Measure left_limits{"x_px", arv_camera_get_x_offset_bounds,
                              arv_camera_get_x_offset_increment};
constexpr Measure top_limits{"y_px", arv_camera_get_y_offset_bounds,
                             arv_camera_get_y_offset_increment};

void check(const Features& device, const Measure& measure, std::optional<int> wanted) {
  if (!wanted) return;
  gint least = 0;
  gint most = 0;
  device.ask(measure.key, measure.bounds, &least, &most);
  const int step = std::max(1, device.ask(measure.key, measure.step));
  if (*wanted < least || *wanted > most || (*wanted - least) % step != 0)
    device.fail(std::string(measure.key) + ": is " + std::to_string(*wanted) + ", it takes " +
                std::to_string(least) + ".." + std::to_string(most) +
                (step > 1 ? " in steps of " + std::to_string(step) : ""));
}

/// Part of the sensor that is read: the size of the pictures.
struct Region {
  gint x = 0;
  gint y = 0;
  gint width = 0;
  gint height = 0;
  bool operator==(const Region&) const = default;
};

std::string text_of(const Region& r) {
  return size_text(r.width, r.height) + " at " + std::to_string(r.x) + "," + std::to_string(r.y);
}

Region region_of(const Features& device) {
  Region r;
  device.ask("region", arv_camera_get_region, &r.x, &r.y, &r.width, &r.height);
  return r;
}

void set_region(const Features& device, const GenicamParams& p) {
  if (!p.width && !p.height && !p.x && !p.y) return;
  const bool moves = device.ask("region", arv_camera_is_region_offset_available) != 0;
  if (!moves && (p.x.value_or(0) != 0 || p.y.value_or(0) != 0))
    device.fail("x_px, y_px: its region cannot be moved");
  const Region before = region_of(device);
  const Region wanted{p.x.value_or(before.x), p.y.value_or(before.y),
                      p.width.value_or(before.width), p.height.value_or(before.height)};
  // The largest size depends on the place, and the other way round.
  if (moves && before != wanted)
    device.ask("region", arv_camera_set_region, 0, 0, before.width, before.height);
  check(device, width_limits, p.width);
  check(device, height_limits, p.height);
  const gint as_it_is = -1;
  device.ask("region", arv_camera_set_region, as_it_is, as_it_is, wanted.width, wanted.height);
  if (moves) {
    check(device, left_limits, wanted.x);
    check(device, top_limits, wanted.y);
    device.ask("region", arv_camera_set_region, wanted.x, wanted.y, wanted.width, wanted.height);
  }
  if (const Region has = region_of(device); has != wanted)
    device.fail("reads the region " + text_of(has) + ", asked for was " + text_of(wanted));
}

/// A setting with a number that the camera takes, or chooses by itself.
struct Adjustable {
  const char* key;
  const char* noun;
  double steps;  ///< of the camera in a unit of the key
  gboolean (*is_there)(ArvCamera*, GError**);
  void (*bounds)(ArvCamera*, double*, double*, GError**);
  void (*set)(ArvCamera*, double, GError**);
  double (*get)(ArvCamera*, GError**);
  gboolean (*can_choose)(ArvCamera*, GError**) = nullptr;
  void (*let_choose)(ArvCamera*, ArvAuto, GError**) = nullptr;
};
constexpr Adjustable exposure_time{"exposure_ms",
                                   "exposure time",
                                   1e3,  // µs
                                   arv_camera_is_exposure_time_available,
                                   arv_camera_get_exposure_time_bounds,
                                   arv_camera_set_exposure_time,
                                   arv_camera_get_exposure_time,
                                   arv_camera_is_exposure_auto_available,
                                   arv_camera_set_exposure_time_auto};
constexpr Adjustable gain_of_camera{"gain",
                                    "gain",
                                    1,
                                    arv_camera_is_gain_available,
                                    arv_camera_get_gain_bounds,
                                    arv_camera_set_gain,
                                    arv_camera_get_gain,
                                    arv_camera_is_gain_auto_available,
                                    arv_camera_set_gain_auto};
constexpr Adjustable frame_rate{"rate_hz",
                                "frame rate",
                                1,
                                arv_camera_is_frame_rate_available,
                                arv_camera_get_frame_rate_bounds,
                                arv_camera_set_frame_rate,
                                arv_camera_get_frame_rate};

void adjust(const Features& device, const Adjustable& what, std::optional<double> wanted) {
  if (!wanted) return;
  const std::string key(what.key);
  const auto text = [&](double v) { return number_text(v / what.steps); };
  if (device.ask(what.key, what.is_there) == 0) device.fail(key + ": it takes no " + what.noun);
  if (what.can_choose && device.ask(what.key, what.can_choose) != 0)
    device.ask(what.key, what.let_choose, ARV_AUTO_OFF);
  const double value = what.steps * *wanted;
  double least = 0;
  double most = 0;
  device.ask(what.key, what.bounds, &least, &most);
  // Aravis would hand on what is out of range.
  if (value < least || value > most)
    device.fail(key + ": is " + text(value) + ", it takes " + text(least) + ".." + text(most));
  device.ask(what.key, what.set, value);
  const double has = device.ask(what.key, what.get);
  if (std::abs(has - value) > tolerance * std::abs(value) + 1e-9)
    device.fail(key + ": it takes " + text(has) + " in place of " + text(value));
}

/// Lets pictures come one after the other at the camera's own pace.
void run_freely(const Features& device) {
  if (device.has("AcquisitionMode"))
    device.ask("acquisition mode", arv_camera_set_acquisition_mode,
               ARV_ACQUISITION_MODE_CONTINUOUS);
  if (device.has("TriggerSelector"))
    device.ask("trigger", arv_camera_clear_triggers);
  else if (device.has("TriggerMode"))
    device.ask("trigger", arv_camera_set_string, "TriggerMode", "Off");
}

/// The rate at which pictures come [Hz], where the camera tells.
std::optional<double> rate_of(const Features& device, bool was_set) {
  if (was_set) return device.ask("rate", arv_camera_get_frame_rate);
  for (const char* feature : {"ResultingFrameRate", "AcquisitionResultingFrameRate"})
    if (device.has(feature)) return device.ask("rate", arv_camera_get_float, feature);
  return std::nullopt;
}

void set_packet_size(const Features& device, std::optional<int> wanted) {
  if (!wanted) return;
  if (arv_camera_is_gv_device(device.camera()) == 0)
    device.fail("packet_size: only a camera of GigE Vision has packets");
  arv_camera_gv_set_packet_size_adjustment(device.camera(), ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
  device.ask("packet_size", arv_camera_gv_set_packet_size, *wanted);
  const int has = static_cast<int>(device.ask("packet_size", arv_camera_gv_get_packet_size));
  if (has != *wanted)
    device.fail("packet_size: it takes " + std::to_string(has) + " in place of " +
                std::to_string(*wanted));
}

/// The id of the first camera that is found.
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
                        "; found: " + list_of(found_devices()));
  return {name, std::move(camera)};
}

const char* damage_of(ArvBufferStatus status) {
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
    set_format(device_, p.pixel_format);
    set_region(device_, p);
    adjust(device_, exposure_time, p.exposure);
    adjust(device_, gain_of_camera, p.gain);
    run_freely(device_);
    adjust(device_, frame_rate, p.rate);
    set_packet_size(device_, p.packet_size);
    rate_ = rate_of(device_, p.rate.has_value());
    start();
  }
  ~GenicamDevice() override {
    Complaint ignored;
    if (stream_ && !*lost_) arv_camera_stop_acquisition(device_.camera(), ignored.out());
    if (taken_) g_object_unref(taken_);
  }

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
    // The signal comes in a thread of Aravis, maybe while this object ends.
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
    if (size == 0 || size > max_payload) fail("tells no size of its pictures");
    for (int i = 0; i < buffers; ++i)
      arv_stream_push_buffer(stream_.get(), arv_buffer_new(size, nullptr));
    form_ = region_of(device_);
    if (form_.width <= 0 || form_.height <= 0 || form_.width > max_image_side ||
        form_.height > max_image_side)
      fail("gives pictures of " + text_of(form_) + " pixels");
    code_ = device_.ask("pixel_format", arv_camera_get_pixel_format);
    device_.ask("start", arv_camera_start_acquisition);
  }

  /// The data in the buffer that was taken.
  RawPicture picture() const {
    RawPicture raw{.format = known(code_)->data,
                   .width = form_.width,
                   .height = form_.height,
                   .bytes_per_line = 0,
                   .bytes = {},
                   .damage = damage_of(arv_buffer_get_status(taken_))};
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

std::string sizes_of(const Features& device) {
  gint least[2]{};
  gint most[2]{};
  device.ask("width_px", width_limits.bounds, &least[0], &most[0]);
  device.ask("height_px", height_limits.bounds, &least[1], &most[1]);
  return size_text(least[0], least[1]) + ".." + size_text(most[0], most[1]);
}

ListedCamera listed(const FoundDevice& found) {
  ListedCamera camera{
      .device = "genicam:" + found.id, .model = found.model, .formats = {}, .trouble = {}};
  try {
    const Features device = open_features(found.id, false);
    const std::string sizes = sizes_of(device);
    const std::vector<ArvPixelFormat> codes = offered_codes(device);
    const std::vector<std::string> names = offered_names(device);
    for (std::size_t i = 0; i < std::min(codes.size(), names.size()); ++i)
      camera.formats.push_back({names[i], known(codes[i]) != nullptr, sizes});
  } catch (const HardwareError& error) {
    camera.trouble = error.what();
  }
  return camera;
}

}  // namespace

std::unique_ptr<CameraDevice> open_genicam(const GenicamParams& params) {
  const QuietLog quiet;
  return std::make_unique<GenicamDevice>(params.device.empty() ? first_id() : params.device,
                                         params);
}

std::vector<ListedCamera> list_genicam_cameras() {
  const QuietLog quiet;
  std::vector<ListedCamera> list;
  for (const FoundDevice& found : found_devices()) list.push_back(listed(found));
  return list;
}

bool has_genicam() { return true; }

}  // namespace microswarm
