// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/video_recorder.hpp"
#include "microswarm/core/execution/inheriting_mutex.hpp"

#include <cerrno>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/priority.hpp"
#include "microswarm/core/text/durable_rename.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/media/media.hpp"
#include "microswarm/vision/image/mat.hpp"

namespace microswarm::vision {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_queued_frames = 64;
constexpr std::size_t max_queued_bytes = std::size_t{256} << 20;
constexpr std::size_t measured_frames = 8;  // of which the rate is taken if none is given
constexpr double usual_rate = 30;           // [Hz] without any

fs::path part_file(const fs::path& file) {
  fs::path part = file;
  return part.replace_extension(".part" + file.extension().string());
}

/// Creates a new file, replacing one of this name. A link is not followed.
std::FILE* create_new(const fs::path& file, const fs::path& called) {
  std::error_code none;
  fs::remove(file, none);
  std::FILE* const made = std::fopen(file.c_str(), "wxe");
  if (!made)
    throw InputError(called.string(), "cannot write: " + std::generic_category().message(errno));
  return made;
}

std::unique_ptr<formats::VideoOutput> open_video(const fs::path& file, double rate, cv::Size size,
                                                 bool colours) {
  return formats::media().create(
      file, {.codec = colours ? formats::VideoCodec::huffyuv : formats::VideoCodec::ffv1,
             .rate = rate,
             .width = size.width,
             .height = size.height,
             .colours = colours});
}

}  // namespace

/// State shared by the camera's thread and the writer; it lives as long as either.
struct VideoRecorder::Shared {
  struct QueuedFrame {
    formats::Image picture;
    int index = 0;
    double taken = 0;
  };

  InheritingMutex mutex;
  std::condition_variable_any changed;
  bool open = true;
  std::optional<double> zero;
  std::deque<QueuedFrame> queue;
  std::size_t bytes = 0;                ///< in the queue
  std::vector<formats::Image> buffers;  ///< for reuse
  int dropped = 0;

  void add(const VideoFrame& frame, double taken) {
    QueuedFrame next{.picture = {}, .index = frame.index, .taken = taken};
    {
      const std::lock_guard lock(mutex);
      if (!open) return;
      const std::size_t size = frame.picture.pixels.size();
      if (queue.size() >= max_queued_frames || bytes + size > max_queued_bytes) {
        ++dropped;
        return;
      }
      bytes += size;
      if (!buffers.empty()) {
        next.picture = std::move(buffers.back());
        buffers.pop_back();
      }
    }
    next.picture = frame.picture;  // outside of the lock, so that the writer does not wait
    const std::lock_guard lock(mutex);
    queue.push_back(std::move(next));
    changed.notify_one();
  }

  /// Waits for the next frame; nothing after the end.
  std::optional<QueuedFrame> take() {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return (zero && !queue.empty()) || !open; });
    if (!zero || queue.empty()) return std::nullopt;
    QueuedFrame next = std::move(queue.front());
    queue.pop_front();
    bytes -= next.picture.pixels.size();
    return next;
  }

  void give_back(formats::Image buffer) {
    const std::lock_guard lock(mutex);
    buffers.push_back(std::move(buffer));
  }

  void close() {
    const std::lock_guard lock(mutex);
    open = false;
    changed.notify_all();
  }
};

/// Writes the queue in its own thread.
class VideoRecorder::Writer {
 public:
  Writer(std::shared_ptr<Shared> shared, const fs::path& file, double rate)
      : shared_(std::move(shared)),
        rate_(std::isfinite(rate) && rate > 0 ? rate : 0),
        part_(part_file(file)),
        times_file_(times_file(file)),
        result_{.file = file} {
    std::fclose(create_new(part_, file));
    if (!open_video(part_, rate_ > 0 ? rate_ : usual_rate, {64, 64}, true))
      throw InputError(file.string(), "cannot write: no encoder for it");
    times_.reset(create_new(part_file(times_file_), times_file_));
    std::fputs("frame,camera_frame,t_s\n", times_.get());
    thread_ = std::thread([this] { run(); });
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() {
    const bool unfinished = thread_.joinable();
    join();
    if (!unfinished || result_.frames > 0) return;
    std::error_code none;
    for (const fs::path& empty : {part_, part_file(times_file_)}) fs::remove(empty, none);
  }

  const RecordedVideo& finish() {
    if (!thread_.joinable()) return result_;
    join();
    video_.reset();
    result_.dropped = shared_->dropped;
    bool good = std::ferror(times_.get()) == 0;
    good = std::fclose(times_.release()) == 0 && good;
    if (result_.trouble.empty() && result_.frames == 0) result_.trouble = "no picture came";
    if (result_.trouble.empty() &&
        (!good || formats::media().count_pictures(part_) < result_.frames))
      result_.trouble = "write failed";
    if (result_.trouble.empty()) give_names();
    if (!result_.trouble.empty())
      result_.trouble = result_.file.string() + ": " + result_.trouble +
                        "; partial video kept as " + part_.string();
    return result_;
  }

 private:
  struct CloseFile {
    void operator()(std::FILE* open) const { std::fclose(open); }
  };

  void join() {
    shared_->close();
    if (thread_.joinable()) thread_.join();
  }

  void give_names() {
    if (!rename_durably(part_file(times_file_), times_file_) ||
        !rename_durably(part_, result_.file))
      result_.trouble = std::generic_category().message(errno);
  }

  void run() {
    lower_priority();
    while (auto frame = shared_->take()) {
      first_.push_back(std::move(*frame));
      if (rate_ > 0 || first_.size() >= measured_frames) write_first();
    }
    write_first();
  }

  /// Writes the frames that wait, at a rate that is theirs if none is given.
  void write_first() {
    if (!(rate_ > 0) && !first_.empty()) {
      const double passed = first_.back().taken - first_.front().taken;
      const double measured = static_cast<double>(first_.size() - 1) / passed;
      rate_ =
          std::isfinite(measured) && measured >= 0.01 && measured <= 1000 ? measured : usual_rate;
    }
    for (Shared::QueuedFrame& frame : first_) {
      if (result_.trouble.empty()) {
        try {
          write(frame);
        } catch (const std::exception& e) {
          result_.trouble = one_line(e.what());
        }
      }
      shared_->give_back(std::move(frame.picture));
    }
    first_.clear();
  }

  void write(const Shared::QueuedFrame& frame) {
    const formats::Image& p = frame.picture;
    if (!video_) video_ = open_video(part_, rate_, {p.width, p.height}, p.channels == 3);
    if (!video_) throw InputError("no encoder for its pictures");
    if (p.channels == 3) {
      cv::cvtColor(as_mat(p), bgr_, cv::COLOR_RGB2BGR);
      video_->write(bgr_);
    } else {
      video_->write(as_mat(p));
    }
    std::fprintf(times_.get(), "%d,%d,%.6f\n", result_.frames, frame.index,
                 frame.taken - *shared_->zero);
    ++result_.frames;
  }

  std::shared_ptr<Shared> shared_;
  double rate_;                             ///< [Hz]; 0 until it is measured
  std::vector<Shared::QueuedFrame> first_;  ///< wait for the rate
  fs::path part_;
  fs::path times_file_;
  RecordedVideo result_;
  std::unique_ptr<formats::VideoOutput> video_;
  cv::Mat bgr_;
  std::unique_ptr<std::FILE, CloseFile> times_;
  std::thread thread_;
};

VideoRecorder::VideoRecorder(const fs::path& file, double rate)
    : shared_(std::make_shared<Shared>()), writer_(std::make_unique<Writer>(shared_, file, rate)) {}

VideoRecorder::~VideoRecorder() = default;

fs::path VideoRecorder::times_file(const fs::path& video) {
  fs::path times = video;
  return times.replace_extension(".csv");
}

FrameListener VideoRecorder::input() const {
  return [shared = shared_](const VideoFrame& frame, double taken) { shared->add(frame, taken); };
}

void VideoRecorder::begin(double zero) {
  const std::lock_guard lock(shared_->mutex);
  if (!shared_->zero) shared_->zero = zero;
  shared_->changed.notify_all();
}

const RecordedVideo& VideoRecorder::finish() { return writer_->finish(); }

}  // namespace microswarm::vision
