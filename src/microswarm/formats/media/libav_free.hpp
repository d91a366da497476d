// SPDX-License-Identifier: Apache-2.0
// Inside the module only.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libswscale/swscale.h>
}

#include <memory>

namespace microswarm::formats {

/// Calls the function that frees a libav object through its address.
template <auto Free>
struct FreeBy {
  template <class T>
  void operator()(T* object) const {
    Free(&object);
  }
};
struct FreeScaler {
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};

using Coder = std::unique_ptr<AVCodecContext, FreeBy<avcodec_free_context>>;
using Packet = std::unique_ptr<AVPacket, FreeBy<av_packet_free>>;
using Frame = std::unique_ptr<AVFrame, FreeBy<av_frame_free>>;
using Scaler = std::unique_ptr<SwsContext, FreeScaler>;

}  // namespace microswarm::formats
