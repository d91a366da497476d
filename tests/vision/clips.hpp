// SPDX-License-Identifier: Apache-2.0
// Videos whose pictures are shown at given times, written by FFmpeg's libraries.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <vector>

namespace microswarm::test {

/// How a video is stored.
struct ClipForm {
  const char* encoder;
  AVPixelFormat pixels = AV_PIX_FMT_YUV420P;
  AVRational tick{1, 1000};
  int b_frames = 0;
  AVRational aspect{1, 1};  ///< of the pixels, width to height
};

/// Grey of a pixel: which picture, column, row.
using ClipGrey = std::function<int(int, int, int)>;

inline constexpr int clip_width = 64, clip_height = 48;

/// Grey of picture k in clips of even pictures.
inline int clip_grey(int k) { return 40 + 8 * k; }

/// Writes a picture at each of the times [s]; false without such an encoder.
inline bool write_clip(
    const std::filesystem::path& file, const ClipForm& form, const std::vector<double>& times,
    const ClipGrey& grey = [](int k, int, int) { return clip_grey(k); }) {
  const AVCodec* encoder = avcodec_find_encoder_by_name(form.encoder);
  if (!encoder) return false;
  const auto check = [](int code) { ASSERT_GE(code, 0); };
  AVFormatContext* out = nullptr;
  check(avformat_alloc_output_context2(&out, nullptr, nullptr, file.c_str()));
  AVStream* stream = avformat_new_stream(out, nullptr);
  AVCodecContext* codec = avcodec_alloc_context3(encoder);
  codec->width = clip_width;
  codec->height = clip_height;
  codec->pix_fmt = form.pixels;
  codec->sample_aspect_ratio = stream->sample_aspect_ratio = form.aspect;
  codec->time_base = form.tick;
  codec->max_b_frames = form.b_frames;
  codec->gop_size = 12;
  codec->bit_rate = 4'000'000;
  codec->strict_std_compliance = FF_COMPLIANCE_EXPERIMENTAL;
  av_opt_set(codec->priv_data, "lag-in-frames", "0", 0);
  av_opt_set(codec->priv_data, "crf", "4", 0);
  if (out->oformat->flags & AVFMT_GLOBALHEADER) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  check(avcodec_open2(codec, encoder, nullptr));
  check(avcodec_parameters_from_context(stream->codecpar, codec));
  stream->time_base = form.tick;
  check(avio_open(&out->pb, file.c_str(), AVIO_FLAG_WRITE));
  out->avoid_negative_ts = AVFMT_AVOID_NEG_TS_DISABLED;
  check(avformat_write_header(out, nullptr));
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();
  frame->width = clip_width;
  frame->height = clip_height;
  frame->format = form.pixels;
  check(av_frame_get_buffer(frame, 0));
  const double span = times.back() - times.front();
  const double between = times.size() > 1 ? span / static_cast<double>(times.size() - 1) : 1;
  const std::int64_t usual = std::max(1L, std::lround(between / av_q2d(stream->time_base)));
  const auto drain = [&] {
    while (avcodec_receive_packet(codec, packet) == 0) {
      av_packet_rescale_ts(packet, codec->time_base, stream->time_base);
      packet->stream_index = stream->index;
      packet->duration = usual;  // else MP4 hides the last picture
      check(av_interleaved_write_frame(out, packet));
    }
  };
  for (std::size_t k = 0; k < times.size(); ++k) {
    check(av_frame_make_writable(frame));
    for (int plane = 0; plane < 3 && frame->data[plane]; ++plane)
      for (int y = 0; y < (plane == 0 ? clip_height : clip_height / 2); ++y)
        for (int x = 0; x < (plane == 0 ? clip_width : clip_width / 2); ++x)
          frame->data[plane][y * frame->linesize[plane] + x] =
              static_cast<std::uint8_t>(plane == 0 ? grey(static_cast<int>(k), x, y) : 128);
    frame->pts = std::llround(times[k] / av_q2d(form.tick));
    check(avcodec_send_frame(codec, frame));
    drain();
  }
  check(avcodec_send_frame(codec, nullptr));
  drain();
  check(av_write_trailer(out));
  avio_closep(&out->pb);
  av_frame_free(&frame);
  av_packet_free(&packet);
  avcodec_free_context(&codec);
  avformat_free_context(out);
  return true;
}

}  // namespace microswarm::test
