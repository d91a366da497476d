// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "lab/stream/publisher.hpp"
#include "microswarm/core/execution/inheriting_mutex.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"

namespace microswarm::lab {

/// Sends a camera's pictures to the pages, at most 15 a second. They are compressed in a separate
/// thread; offer() only copies a picture.
class PictureSender {
 public:
  explicit PictureSender(Publisher::Send send)
      : send_(std::move(send)), thread_([this] { run(); }) {}
  ~PictureSender();
  PictureSender(const PictureSender&) = delete;
  PictureSender& operator=(const PictureSender&) = delete;

  /// Takes a picture, unless the last one was sent too recently or is still being compressed.
  void offer(const formats::Image& picture, const vision::CameraScale& scale, double t);
  /// Sends the last picture to a page.
  void welcome(std::uint64_t page);

 private:
  struct Offer {
    formats::Image picture;
    vision::CameraScale scale;
    double t = 0;
  };
  void run();

  Publisher::Send send_;
  InheritingMutex mutex_;
  std::condition_variable_any offered_;
  std::optional<Offer> offer_;
  bool ends_ = false;
  MessagePtr last_;
  std::chrono::steady_clock::time_point next_{};
  std::thread thread_;
};

}  // namespace microswarm::lab
