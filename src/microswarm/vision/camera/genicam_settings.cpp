// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "microswarm/vision/camera/aravis.hpp"

namespace microswarm::vision {
namespace {

constexpr double tolerance = 0.05;  // relative, for values that the camera rounds

/// A format: our name, Aravis's code, layout of the data.
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
std::string size_text(int columns, int rows) {
  return std::to_string(columns) + "x" + std::to_string(rows);
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
        to_text(device.ask(key, arv_camera_get_pixel_format_as_string)) +
        ", which is not read, see pixel_format; its formats are: " + offered_formats(device));
}

/// An integer setting of the camera and its admissible values.
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
void set_region(const Features& device, const GenicamParams& p) {
  if (!p.width && !p.height && !p.x && !p.y) return;
  const bool moves = device.ask("region", arv_camera_is_region_offset_available) != 0;
  if (!moves && (p.x.value_or(0) != 0 || p.y.value_or(0) != 0))
    device.fail("x_px, y_px: its region cannot be moved");
  const Region before = read_region(device);
  const Region wanted{p.x.value_or(before.x), p.y.value_or(before.y),
                      p.width.value_or(before.width), p.height.value_or(before.height)};
  // The maximum size depends on the offset, and vice versa.
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
  if (const Region has = read_region(device); has != wanted)
    device.fail("reads the region " + to_text(has) + ", asked for was " + to_text(wanted));
}

/// A numerical setting that can be given or automatic.
struct Adjustable {
  const char* key;
  const char* noun;
  double steps;  ///< camera's steps in one unit of the key
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
  // Aravis does not check the range.
  if (value < least || value > most)
    device.fail(key + ": is " + text(value) + ", it takes " + text(least) + ".." + text(most));
  device.ask(what.key, what.set, value);
  const double has = device.ask(what.key, what.get);
  if (std::abs(has - value) > tolerance * std::abs(value) + 1e-9)
    device.fail(key + ": it takes " + text(has) + " in place of " + text(value));
}

/// Selects continuous, free-running acquisition.
void run_freely(const Features& device) {
  if (device.has("AcquisitionMode"))
    device.ask("acquisition mode", arv_camera_set_acquisition_mode,
               ARV_ACQUISITION_MODE_CONTINUOUS);
  if (device.has("TriggerSelector"))
    device.ask("trigger", arv_camera_clear_triggers);
  else if (device.has("TriggerMode"))
    device.ask("trigger", arv_camera_set_string, "TriggerMode", "Off");
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
}  // namespace

std::optional<PixelFormat> to_pixel_format(ArvPixelFormat code) {
  const KnownFormat* const format = known(code);
  if (!format) return std::nullopt;
  return format->data;
}

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
  for (guint i = 0; names && i < count; ++i) offered.push_back(to_text(names[i]));
  g_free(names);
  return offered;
}
std::string offered_sizes(const Features& device) {
  gint least[2]{};
  gint most[2]{};
  device.ask("width_px", width_limits.bounds, &least[0], &most[0]);
  device.ask("height_px", height_limits.bounds, &least[1], &most[1]);
  return size_text(least[0], least[1]) + ".." + size_text(most[0], most[1]);
}
std::string to_text(const Region& r) {
  return size_text(r.width, r.height) + " at " + std::to_string(r.x) + "," + std::to_string(r.y);
}

Region read_region(const Features& device) {
  Region r;
  device.ask("region", arv_camera_get_region, &r.x, &r.y, &r.width, &r.height);
  return r;
}
std::optional<double> read_rate(const Features& device, bool was_set) {
  if (was_set) return device.ask("rate", arv_camera_get_frame_rate);
  for (const char* feature : {"ResultingFrameRate", "AcquisitionResultingFrameRate"})
    if (device.has(feature)) return device.ask("rate", arv_camera_get_float, feature);
  return std::nullopt;
}
void apply(const GenicamParams& p, const Features& device) {
  set_format(device, p.pixel_format);
  set_region(device, p);
  adjust(device, exposure_time, p.exposure);
  adjust(device, gain_of_camera, p.gain);
  run_freely(device);
  adjust(device, frame_rate, p.rate);
  set_packet_size(device, p.packet_size);
}

}  // namespace microswarm::vision
