// SPDX-License-Identifier: Apache-2.0
// H.264 by FFmpeg's libraries. OpenCV's videoio cannot limit the pictures that the encoder looks
// ahead at, some hundred.
#include "microswarm/formats/media/libav_output.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <cerrno>
#include <opencv2/core.hpp>
#include <string>
#include <thread>

#include "microswarm/formats/media/libav_free.hpp"
#include "microswarm/formats/media/libav_messages.hpp"

namespace microswarm::formats {
namespace {

namespace fs = std::filesystem;

struct CloseOutput {
  void operator()(AVFormatContext* format) const {
    avio_closep(&format->pb);
    avformat_free_context(format);
  }
};

class H264Output : public VideoOutput {
 public:
  H264Output() : packet_(av_packet_alloc()), frame_(av_frame_alloc()) {}
  H264Output(const H264Output&) = delete;
  H264Output& operator=(const H264Output&) = delete;
  ~H264Output() override { end(); }

  /// False without an encoder; what the file refuses is kept for finish().
  bool open(const fs::path& file, const VideoForm& form) {
    const std::string url = "file:" + fs::absolute(file).string();
    AVFormatContext* made = nullptr;
    if (avformat_alloc_output_context2(&made, nullptr, nullptr, url.c_str()) < 0) return false;
    format_.reset(made);
    const AVCodec* const codec = avcodec_find_encoder(AV_CODEC_ID_H264);
    encoder_.reset(codec ? avcodec_alloc_context3(codec) : nullptr);
    if (!encoder_ || !packet_ || !frame_ || !open_encoder(*codec, form)) return false;
    stream_ = avformat_new_stream(made, nullptr);
    if (!stream_ || avcodec_parameters_from_context(stream_->codecpar, encoder_.get()) < 0)
      return false;
    stream_->time_base = encoder_->time_base;
    stream_->avg_frame_rate = encoder_->framerate;
    keep(avio_open(&made->pb, url.c_str(), AVIO_FLAG_WRITE));
    if (error_ != 0) return true;
    is_begun_ = avformat_write_header(made, nullptr) >= 0;
    keep(made->pb->error);
    return is_begun_ || error_ != 0;
  }

  void write(const cv::Mat& picture) override {
    if (error_ != 0) return;
    keep(av_frame_make_writable(frame_.get()));
    if (picture.cols < frame_->width || picture.rows < frame_->height) keep(AVERROR(EINVAL));
    if (error_ != 0) return;
    scaler_.reset(sws_getCachedContext(scaler_.release(), frame_->width, frame_->height,
                                       AV_PIX_FMT_BGR24, frame_->width, frame_->height,
                                       encoder_->pix_fmt, SWS_BICUBIC, nullptr, nullptr, nullptr));
    if (!scaler_) return keep(AVERROR(ENOMEM));
    const std::uint8_t* from[4] = {picture.data, nullptr, nullptr, nullptr};
    const int steps[4] = {static_cast<int>(picture.step), 0, 0, 0};
    sws_scale(scaler_.get(), from, steps, 0, frame_->height, frame_->data, frame_->linesize);
    frame_->pts = pictures_++;
    encode(frame_.get());
  }

  int finish() override {
    end();
    return error_;
  }

 private:
  /// Keeps the first error, as errno; those of the library itself as EIO.
  void keep(int code) {
    constexpr int max_errno = 4095;
    if (code < 0 && error_ == 0) error_ = -code <= max_errno ? -code : EIO;
  }

  void end() {
    if (!format_) return;
    if (is_begun_) {
      encode(nullptr);
      keep(av_write_trailer(format_.get()));
    }
    keep(avio_closep(&format_->pb));
    format_.reset();
  }

  bool open_encoder(const AVCodec& codec, const VideoForm& form) {
    constexpr int even = ~1;  // colours are stored for two by two pixels
    AVCodecContext& to = *encoder_;
    to.width = form.width & even;
    to.height = form.height & even;
    to.pix_fmt = AV_PIX_FMT_YUV420P;
    to.framerate = av_d2q(form.rate, 1'000'000);
    to.time_base = av_inv_q(to.framerate);
    if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0)
      to.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    const HeldPictures held =
        held_pictures(form.width, form.height, std::thread::hardware_concurrency());
    to.thread_count = held.threads;
    to.max_b_frames = held.reordered;
    to.refs = held.references;
    av_opt_set(to.priv_data, "crf", "23", 0);
    av_opt_set_int(to.priv_data, "rc-lookahead", held.ahead, 0);
    av_opt_set(to.priv_data, "x264-params", "sync-lookahead=0", 0);
    if (avcodec_open2(&to, &codec, nullptr) < 0) return false;
    frame_->format = to.pix_fmt;
    frame_->width = to.width;
    frame_->height = to.height;
    return av_frame_get_buffer(frame_.get(), 0) >= 0;
  }

  /// Gives the encoder a picture, or the end, and writes what is ready.
  void encode(const AVFrame* picture) {
    keep(avcodec_send_frame(encoder_.get(), picture));
    while (avcodec_receive_packet(encoder_.get(), packet_.get()) >= 0) {
      av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
      packet_->stream_index = stream_->index;
      keep(av_interleaved_write_frame(format_.get(), packet_.get()));
    }
  }

  std::unique_ptr<AVFormatContext, CloseOutput> format_;
  Coder encoder_;
  Packet packet_;
  Frame frame_;
  Scaler scaler_;
  AVStream* stream_ = nullptr;
  std::int64_t pictures_ = 0;
  bool is_begun_ = false;
  int error_ = 0;  ///< the first, as errno
};

}  // namespace

std::unique_ptr<VideoOutput> create_h264(const fs::path& file, const VideoForm& form) {
  set_messages();
  auto output = std::make_unique<H264Output>();
  if (!output->open(file, form)) return nullptr;
  return output;
}

}  // namespace microswarm::formats
