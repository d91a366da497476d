// SPDX-License-Identifier: Apache-2.0
// Videos by FFmpeg's libraries, which OpenCV's videoio uses as well. videoio reports
// neither the times of all pictures nor which are not shown.
#include "microswarm/formats/media/libav_input.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "microswarm/formats/media/libav_free.hpp"
#include "microswarm/formats/media/libav_messages.hpp"

namespace microswarm::formats {
namespace {

constexpr std::string_view file_protocol = "file:";  // so that no name is another protocol

namespace fs = std::filesystem;

constexpr int max_bad_packets = 64;                    // before the first picture
constexpr std::int64_t max_video_pixels = 64'000'000;  // as of images

using Format = std::unique_ptr<AVFormatContext, FreeBy<avformat_close_input>>;

/// Reads the first pictures, none larger than allowed.
bool find_streams(AVFormatContext& format) {
  std::vector<AVDictionary*> options(format.nb_streams);
  std::vector<std::pair<int, int>> sizes(format.nb_streams);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const AVCodecParameters& told = *format.streams[i]->codecpar;
    sizes[i] = {told.width, told.height};
    av_dict_set_int(&options[i], "max_pixels", max_video_pixels, 0);
  }
  const int code = avformat_find_stream_info(&format, options.data());
  for (AVDictionary*& of_stream : options) av_dict_free(&of_stream);
  for (std::size_t i = 0; i < sizes.size(); ++i) {  // it forgets those beyond
    AVCodecParameters& told = *format.streams[i]->codecpar;
    if (told.width == 0) std::tie(told.width, told.height) = sizes[i];
  }
  return code >= 0;
}

/// A file only: a playlist may not name an address.
Format open_format(const fs::path& file) {
  AVFormatContext* opened = nullptr;
  AVDictionary* options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  const std::string url = std::string(file_protocol) + fs::absolute(file).string();
  const int code = avformat_open_input(&opened, url.c_str(), nullptr, &options);
  av_dict_free(&options);
  if (code < 0) return nullptr;
  Format format(opened);
  return find_streams(*format) ? std::move(format) : nullptr;
}

/// Turn of stored pictures to be shown: transposed first, then mirrored.
struct Turn {
  bool transposed = false, mirrored_x = false, mirrored_y = false;

  static Turn of(const AVStream& stream) {
    const std::uint8_t* data = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
    if (!data) return {};
    std::int32_t m[9];
    std::memcpy(m, data, sizeof m);
    const auto size = [](std::int32_t v) { return std::abs(static_cast<double>(v)); };
    if (size(m[0]) + size(m[4]) >= size(m[1]) + size(m[3])) return {false, m[0] < 0, m[4] < 0};
    return {true, m[3] < 0, m[1] < 0};
  }
  void apply(cv::Mat& picture) const {
    if (transposed) picture = picture.t();
    if (mirrored_x && mirrored_y)
      cv::flip(picture, picture, -1);
    else if (mirrored_x || mirrored_y)
      cv::flip(picture, picture, mirrored_x ? 1 : 0);
  }
};

bool is_avi(const AVFormatContext& format) { return std::strcmp(format.iformat->name, "avi") == 0; }

bool is_gif(const AVFormatContext& format) { return std::strcmp(format.iformat->name, "gif") == 0; }

/// Whether a RIFF file is as long as it says. Of several chunks, each with its length, only the
/// first is looked at.
bool is_whole_riff(const std::string& url) {
  std::ifstream in(url.substr(file_protocol.size()), std::ios::binary);
  std::array<unsigned char, 8> head{};
  in.read(reinterpret_cast<char*>(head.data()), head.size());
  in.seekg(0, std::ios::end);
  const std::uint64_t length =
      head[4] | head[5] << 8U | head[6] << 16U | std::uint64_t{head[7]} << 24U;
  return in && length > 0 && static_cast<std::uint64_t>(in.tellg()) >= head.size() + length;
}

/// Number of pictures that are shown, by the file's header; 0 if unknown.
double told_pictures(AVStream& stream, const AVFormatContext& format) {
  const int entries = avformat_index_get_entries_count(&stream);
  // The header of AVI counts the places of pictures left out, too; its index does not.
  if (is_avi(format) && entries > 0 && is_whole_riff(format.url)) {
    int pictures = 0;
    for (int i = 0; i < entries; ++i)
      pictures += avformat_index_get_entry(&stream, i)->size > 0 ? 1 : 0;
    return pictures;
  }
  // In fragments of MP4 the index grows while they are read.
  if (std::strstr(format.iformat->name, "mov") == nullptr || entries != stream.nb_frames)
    return static_cast<double>(std::max<std::int64_t>(stream.nb_frames, 0));
  int shown = 0;  // an edit list may hide some
  for (int i = 0; i < entries; ++i)
    shown += (avformat_index_get_entry(&stream, i)->flags & AVINDEX_DISCARD_FRAME) == 0;
  return shown;
}

/// Time at which the stream ends by the header [s]; 0 if unknown.
double told_end(const AVFormatContext& format, const AVStream& stream) {
  if (const AVDictionaryEntry* tag = av_dict_get(stream.metadata, "DURATION", nullptr, 0)) {
    int hours = 0, minutes = 0;
    double seconds = 0;
    if (std::sscanf(tag->value, "%d:%d:%lf", &hours, &minutes, &seconds) == 3)
      return 3600.0 * hours + 60.0 * minutes + seconds;
  }
  if (format.duration_estimation_method == AVFMT_DURATION_FROM_BITRATE) return 0;
  if (stream.duration > 0) return static_cast<double>(stream.duration) * av_q2d(stream.time_base);
  if (format.nb_streams == 1 && format.duration > 0)
    return static_cast<double>(format.duration) / AV_TIME_BASE;
  return 0;
}

/// Whether a file of a format without a number of pictures and a duration ends too early: within
/// a picture, or without its last part. `packets_end` is where the last packet read ends [B].
bool ends_early(const AVFormatContext& format, std::int64_t packets_end) {
  constexpr std::streamoff end_part = 64;  // [B], some bytes may follow
  const std::string_view name = format.iformat->name;
  std::ifstream in(std::string(format.url).substr(file_protocol.size()), std::ios::binary);
  in.seekg(0, std::ios::end);
  const std::streamoff size = in.tellg();
  if (!in) return false;
  if (name == "yuv4mpegpipe") return packets_end > 0 && packets_end < size;
  if (name != "apng" && name != "gif") return false;
  in.seekg(std::max<std::streamoff>(0, size - end_part));
  const std::string last{std::istreambuf_iterator<char>(in), {}};
  if (name == "apng") return last.find("IEND") == std::string::npos;
  const std::size_t mark = last.find_last_not_of('\0');
  return mark == std::string::npos || last[mark] != ';';
}

class LibavInput : public VideoInput {
 public:
  LibavInput(Format format, int stream, const AVCodec* codec)
      : format_(std::move(format)),
        stream_(format_->streams[stream]),
        decoder_(avcodec_alloc_context3(codec)),
        packet_(av_packet_alloc()),
        frame_(av_frame_alloc()) {}

  bool open(const AVCodec* codec) {
    if (!decoder_ || !packet_ || !frame_) return false;
    if (avcodec_parameters_to_context(decoder_.get(), stream_->codecpar) < 0) return false;
    decoder_->pkt_timebase = stream_->time_base;
    width = stream_->codecpar->width;
    height = stream_->codecpar->height;
    if (std::int64_t{width} * height > max_video_pixels) return true;  // the caller refuses it
    decoder_->max_pixels = max_video_pixels;  // before memory is taken for them
    decoder_->thread_count = held_pictures(stream_->codecpar->width, stream_->codecpar->height,
                                           std::thread::hardware_concurrency())
                                 .threads;
    if (avcodec_open2(decoder_.get(), codec, nullptr) < 0) return false;
    for (unsigned i = 0; i < format_->nb_streams; ++i)
      if (format_->streams[i] != stream_) format_->streams[i]->discard = AVDISCARD_ALL;
    turn_ = Turn::of(*stream_);
    width = decoder_->width;
    height = decoder_->height;
    take_aspect();
    if (turn_.transposed) std::swap(width, height);
    const AVRational mean = stream_->avg_frame_rate.num > 0
                                ? stream_->avg_frame_rate
                                : av_guess_frame_rate(format_.get(), stream_, nullptr);
    rate = mean.den > 0 ? av_q2d(mean) : 0;
    unit_ = av_q2d(stream_->time_base);
    tick = is_avi(*format_) || is_gif(*format_) ? 0 : unit_;
    picture_count = told_pictures(*stream_, *format_);
    end = told_end(*format_, *stream_);
    return true;
  }

  bool read(cv::Mat& picture) override {
    if (!decode()) return false;
    const std::int64_t shown_at = frame_->best_effort_timestamp;
    time.reset();
    if (shown_at != AV_NOPTS_VALUE) time = static_cast<double>(shown_at) * unit_;
    const bool good = convert(picture);
    av_frame_unref(frame_.get());
    any_ = any_ || good;
    return good;
  }

 private:
  /// The next picture into `frame_`; false at the end or where it cannot be decoded.
  bool decode() {
    for (int bad = 0; bad <= max_bad_packets;) {
      const int code = avcodec_receive_frame(decoder_.get(), frame_.get());
      if (code == 0) return true;
      if (code == AVERROR_EOF) return false;
      if (code != AVERROR(EAGAIN) || !feed()) {
        if (any_) return false;
        ++bad;  // a file may begin within a group of pictures
      }
    }
    return false;
  }
  /// Shown size of pictures whose pixels are no squares, as most programs that play them show it.
  void take_aspect() {
    constexpr double most = 8;  // beyond it a file is wrong
    const AVRational told = av_guess_sample_aspect_ratio(format_.get(), stream_, nullptr);
    const double aspect = told.num > 0 && told.den > 0 ? av_q2d(told) : 1;
    if (aspect > most || aspect < 1 / most) return;
    wider_ = std::max(1.0, aspect);
    higher_ = std::max(1.0, 1 / aspect);
    const int w = stretched(width, wider_), h = stretched(height, higher_);
    if (w == width && h == height) return;
    pixel_aspect = aspect;
    width = w;
    height = h;
  }
  static int stretched(int side, double times) {
    return static_cast<int>(std::lround(times * side));
  }
  /// Gives the decoder the next packet, or the end; false for a damaged one.
  bool feed() {
    for (;;) {
      av_packet_unref(packet_.get());
      if (av_read_frame(format_.get(), packet_.get()) < 0) {
        is_cut = ends_early(*format_, packets_end_);
        return avcodec_send_packet(decoder_.get(), nullptr) >= 0;
      }
      packets_end_ = std::max(packets_end_, packet_->pos + packet_->size);
      if (packet_->stream_index == stream_->index && packet_->size > 0)
        return avcodec_send_packet(decoder_.get(), packet_.get()) >= 0;
    }
  }
  bool convert(cv::Mat& picture) {
    const int stored_w = frame_->width, stored_h = frame_->height;
    if (stored_w < 1 || stored_h < 1) return false;
    const int w = stretched(stored_w, wider_), h = stretched(stored_h, higher_);
    if (std::int64_t{w} * h > max_video_pixels) return false;
    scaler_.reset(sws_getCachedContext(scaler_.release(), stored_w, stored_h,
                                       static_cast<AVPixelFormat>(frame_->format), w, h,
                                       AV_PIX_FMT_BGR24, SWS_BICUBIC, nullptr, nullptr, nullptr));
    if (!scaler_) return false;
    constexpr int aligned = 64;  // [B], of a row
    const int step = (3 * w + aligned - 1) / aligned * aligned;
    rows_.create(h + 1, step, CV_8U);  // one more, as the scaler may write beyond a row
    std::uint8_t* to[4] = {rows_.data, nullptr, nullptr, nullptr};
    const int steps[4] = {step, 0, 0, 0};
    if (sws_scale(scaler_.get(), frame_->data, frame_->linesize, 0, stored_h, to, steps) != h)
      return false;
    picture = cv::Mat(h, w, CV_8UC3, rows_.data, static_cast<std::size_t>(step));
    turn_.apply(picture);
    return true;
  }

  Format format_;
  AVStream* stream_;
  Coder decoder_;
  Packet packet_;
  Frame frame_;
  Scaler scaler_;
  cv::Mat rows_;
  Turn turn_;
  double wider_ = 1, higher_ = 1;  ///< stretches of pictures as shown
  std::int64_t packets_end_ = 0;   ///< in the file [B]
  double unit_ = 0;                ///< of the times in the file [s]
  bool any_ = false;               ///< whether a picture was decoded
};

int best_stream(const Format& format, const AVCodec** codec) {
  return av_find_best_stream(format.get(), AVMEDIA_TYPE_VIDEO, -1, -1, codec, 0);
}

}  // namespace

std::unique_ptr<VideoInput> open_libav(const fs::path& file) {
  set_messages();
  Format format = open_format(file);
  if (!format) return nullptr;
  const AVCodec* codec = nullptr;
  const int stream = best_stream(format, &codec);
  if (stream < 0 || !codec) return nullptr;
  auto input = std::make_unique<LibavInput>(std::move(format), stream, codec);
  if (!input->open(codec)) return nullptr;
  return input;
}

int count_libav_packets(const fs::path& file) {
  set_messages();
  const Format format = open_format(file);
  if (!format) return 0;
  const int stream = best_stream(format, nullptr);
  const Packet packet(av_packet_alloc());
  if (stream < 0 || !packet) return 0;
  int count = 0;
  while (av_read_frame(format.get(), packet.get()) >= 0) {
    count += packet->stream_index == stream;
    av_packet_unref(packet.get());
  }
  return count;
}

}  // namespace microswarm::formats
