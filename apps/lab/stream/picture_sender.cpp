// SPDX-License-Identifier: Apache-2.0
#include "lab/stream/picture_sender.hpp"

#include <utility>

#include "lab/stream/rig_stream.hpp"
#include "microswarm/core/execution/priority.hpp"

namespace microswarm::lab {

PictureSender::~PictureSender() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    offered_.notify_all();
  }
  thread_.join();
}

void PictureSender::offer(const formats::Image& picture, const vision::CameraScale& scale,
                          double t) {
  constexpr std::chrono::milliseconds period{66};
  const auto now = std::chrono::steady_clock::now();
  const std::lock_guard lock(mutex_);
  if (offer_ || now < next_ || picture.pixels.empty()) return;
  next_ = now + period;
  offer_ = Offer{picture, scale, t};
  offered_.notify_all();
}

void PictureSender::welcome(std::uint64_t page) {
  const std::lock_guard lock(mutex_);
  if (last_) send_(page, last_);
}

void PictureSender::run() {
  lower_priority();
  std::unique_lock lock(mutex_);
  for (;;) {
    offered_.wait(lock, [this] { return ends_ || offer_; });
    if (ends_) return;
    const Offer offer = *std::exchange(offer_, std::nullopt);
    lock.unlock();
    MessagePtr made;
    try {
      made = picture_message(offer.picture, offer.scale, offer.t);
    } catch (const std::exception&) {
      // A picture that cannot be compressed is skipped.
    }
    lock.lock();
    if (!made) continue;
    last_ = made;
    send_(0, made);
  }
}

}  // namespace microswarm::lab
