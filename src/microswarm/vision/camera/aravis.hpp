// SPDX-License-Identifier: Apache-2.0
#pragma once

// Aravis for genicam_*.cpp only, so that its headers and GLib's macros stay in these files.

#include <arv.h>

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/vision/camera/genicam_params.hpp"
#include "microswarm/vision/camera/raw_pixels.hpp"

namespace microswarm::vision {

/// Deleter that releases a reference to a GLib object.
struct Release {
  void operator()(gpointer object) const { g_object_unref(object); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;
/// Suppresses Aravis's messages in GLib's log, which have no domain.
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

/// The error of one call of Aravis.
class Complaint {
 public:
  Complaint() = default;
  ~Complaint() { g_clear_error(&error_); }
  Complaint(const Complaint&) = delete;
  Complaint& operator=(const Complaint&) = delete;
  GError** out() { return &error_; }
  explicit operator bool() const { return error_ != nullptr; }
  std::string text() const { return error_ ? one_line(error_->message) : "no reason is given"; }

 private:
  GError* error_ = nullptr;
};

/// A text of Aravis as one line; empty for null.
inline std::string to_text(const char* text) { return text ? one_line(text) : ""; }

/// An open camera and the calls of Aravis on it.
class Features {
 public:
  Features(std::string name, Owned<ArvCamera> camera)
      : name_(std::move(name)), camera_(std::move(camera)) {}

  ArvCamera* camera() const { return camera_.get(); }
  [[noreturn]] void fail(const std::string& why) const { throw HardwareError(name_ + ": " + why); }

  /// Calls a function of Aravis, whose last argument is the error.
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

/// Our format of an Aravis format; nothing if it is not supported.
std::optional<PixelFormat> to_pixel_format(ArvPixelFormat code);
/// Codes of the formats that the camera supports.
std::vector<ArvPixelFormat> offered_codes(const Features& camera);
/// Names of these formats, in the same order.
std::vector<std::string> offered_names(const Features& camera);
/// Sizes that the camera supports: "1x1..2048x2048".
std::string offered_sizes(const Features& camera);

/// Part of the sensor that is read; its size is that of the pictures [px].
struct Region {
  gint x = 0;
  gint y = 0;
  gint width = 0;
  gint height = 0;
  bool operator==(const Region&) const = default;
};
/// The region as text: "320x240 at 0,0".
std::string to_text(const Region& region);
/// The camera's current region.
Region read_region(const Features& camera);

/// Applies the given settings and selects free-running acquisition. Throws HardwareError for a
/// setting that the camera refuses.
void apply(const GenicamParams& params, const Features& camera);
/// Frame rate [Hz], if the camera reports it.
std::optional<double> read_rate(const Features& camera, bool was_set);

}  // namespace microswarm::vision
