// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/newest_frame.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::vision {
namespace {

constexpr auto longest_close = std::chrono::milliseconds(900);

using Pixels = std::vector<std::uint8_t>;

bool is_black(const Pixels& pixels, int below) {
  return std::all_of(pixels.begin(), pixels.end(), [&](std::uint8_t g) { return g < below; });
}

/// Hash of a picture, computed in steps of eight bytes.
std::uint64_t fingerprint(const Pixels& pixels) {
  std::uint64_t digest = pixels.size();
  const auto mix = [&](std::uint64_t word) {
    digest = (digest ^ word) * 0x9E3779B97F4A7C15ULL;
    digest ^= digest >> 32;
  };
  std::size_t at = 0;
  for (std::uint64_t word = 0; at + sizeof word <= pixels.size(); at += sizeof word) {
    std::memcpy(&word, pixels.data() + at, sizeof word);
    mix(word);
  }
  for (; at < pixels.size(); ++at) mix(pixels[at]);
  return digest;
}

/// Hashes of the last pictures, to detect repetition: a ring of buffers that is stuck shows a few
/// pictures in turn. A working camera never delivers the same picture twice.
class PastPictures {
 public:
  /// Whether the picture equals one of the last; then adds it to them.
  bool has(const Pixels& pixels) {
    const std::uint64_t digest = fingerprint(pixels);
    const auto end = past_.begin() + std::min<std::ptrdiff_t>(count_, std::ssize(past_));
    const bool found = std::find(past_.begin(), end, digest) != end;
    past_[static_cast<std::size_t>(count_++ % std::ssize(past_))] = digest;
    return found;
  }

 private:
  std::array<std::uint64_t, 32> past_{};
  std::ptrdiff_t count_ = 0;
};

}  // namespace

/// State shared by the thread and its owner; it lives as long as either.
struct NewestFrame::Shared {
  mutable std::mutex mutex;
  std::condition_variable changed;
  bool closing = false;
  bool done = false;   ///< whether the thread is about to end
  bool ended = false;  ///< whether the source has no more pictures
  std::string error;   ///< why it failed
  std::string why_ended;
  double began = steady_seconds();
  LiveFrame newest;
  bool fresh = false;  ///< whether the newest was not taken yet
  int frames = 0;
  int dropped = 0;
  int gaps = 0;
  double usual = 0;         ///< time between two frames [s]; 0 before the second
  double silent_after = 1;  ///< [s]
  int same = 0;             ///< consecutive pictures that are repetitions
  bool black = false;
  FrameListener listener;

  /// To be called with the mutex held.
  CameraStatus status(const std::string& name, const NewestFrameParams& p) const {
    CameraStatus s{.frames = frames,
                   .dropped = dropped,
                   .gaps = gaps,
                   .age = steady_seconds() - (frames > 0 ? newest.taken : began)};
    if (!error.empty()) {
      s.state = CameraState::failed;
      s.why = error;
    } else if (ended) {
      s.state = CameraState::ended;
      s.why = why_ended;
    } else if (s.age > silent_after) {
      s.state = CameraState::silent;
      s.why = name + ": no picture for " + number_text(silent_after) + " s";
    } else if (frames == 0) {
      s.state = CameraState::opening;
    } else {
      s.state = black                    ? CameraState::black
                : same >= p.frozen_after ? CameraState::frozen
                                         : CameraState::live;
    }
    return s;
  }

  void publish(VideoFrame& frame, double taken, bool is_same, bool is_dark) {
    const std::lock_guard lock(mutex);
    dropped += fresh;
    if (frames > 0) count_gap(taken - newest.taken);
    std::swap(newest.frame, frame);
    newest.taken = taken;
    fresh = true;
    ++frames;
    same = is_same ? same + 1 : 1;
    black = is_dark;
    changed.notify_all();
  }

  /// Counts a time between two frames as a gap; the usual one follows, so that a slower camera's
  /// frames soon are none.
  void count_gap(double interval) {
    constexpr int first = 10;  // intervals that only set the usual one
    const bool is_gap = frames > first && interval > 2 * usual;
    gaps += is_gap;
    usual += ((is_gap ? 2 * usual : interval) - usual) / std::min(frames, 100);
  }

  bool is_closing() const {
    const std::lock_guard lock(mutex);
    return closing;
  }

  void fetch_all(FrameSource& source, int black_below) {
    VideoFrame frame;
    PastPictures past;
    while (!is_closing()) {
      if (!source.next(frame)) {
        const std::lock_guard lock(mutex);
        ended = true;
        why_ended = one_line(source.why_ended());
        return;
      }
      const double taken = steady_seconds();
      const bool is_same = past.has(frame.picture.pixels);
      const bool is_dark = is_black(frame.picture.pixels, black_below);
      if (listener) listener(frame, taken);
      publish(frame, taken, is_same, is_dark);
    }
  }

  void run(std::unique_ptr<FrameSource> source, int black_below) {
    std::string why;
    try {
      fetch_all(*source, black_below);
    } catch (const std::exception& e) {
      why = one_line(e.what());
      if (why.empty()) why = "cannot be read";
    }
    {
      const std::lock_guard lock(mutex);
      error = why;
      changed.notify_all();
    }
    source.reset();  // closing a camera may take long
    const std::lock_guard lock(mutex);
    done = true;
    changed.notify_all();
  }
};

NewestFrame::NewestFrame(std::unique_ptr<FrameSource> source, std::string name,
                         const NewestFrameParams& params, FrameListener listener)
    : name_(std::move(name)), params_(params), shared_(std::make_shared<Shared>()) {
  shared_->listener = std::move(listener);
  const double three_frames = 3 / source->rate().value_or(infinity);
  shared_->silent_after = params.silent_after.value_or(std::max(1.0, three_frames));
  // Detached, because a device that hangs must not block its owner; the thread owns its state.
  std::thread([shared = shared_, source = std::move(source), below = params.black_below]() mutable {
    shared->run(std::move(source), below);
  }).detach();
}

NewestFrame::~NewestFrame() {
  std::unique_lock lock(shared_->mutex);
  shared_->closing = true;
  shared_->changed.wait_for(lock, longest_close, [&] { return shared_->done; });
}

bool NewestFrame::wait(LiveFrame& frame, double seconds, double since) {
  std::unique_lock lock(shared_->mutex);
  Shared& s = *shared_;
  s.changed.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
    return (s.fresh && s.newest.taken >= since) || s.ended || !s.error.empty();
  });
  if (s.fresh) {
    std::swap(frame, s.newest);
    s.newest.taken = frame.taken;
    s.fresh = false;
    return true;
  }
  const CameraStatus now = s.status(name_, params_);
  if (!now.why.empty() && now.state != CameraState::ended) throw HardwareError(now.why);
  return false;
}

CameraStatus NewestFrame::status() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->status(name_, params_);
}

}  // namespace microswarm::vision
