// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm {

/// A picture of a video.
struct VideoFrame {
  int index = 0;  ///< from 0
  double t = 0;   ///< [s] since the first
  Image picture;  ///< grey or in colours
};

/// Where pictures come from, one after the other. All have the same size. What shall see by another
/// eye, as a camera, derives from this.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next picture into `frame`, whose memory is used again; false at the end, and from one on
  /// that cannot be read or has another size than the first. Throws InputError "SOURCE: WHY" if
  /// that is the first one.
  virtual bool next(VideoFrame& frame) = 0;
  /// Why it ended before its last picture, "SOURCE: WHY"; empty if it did not.
  virtual std::string why_ended() const { return {}; }
  /// Pictures in all, where that is known beforehand; a video file may hold fewer.
  virtual std::optional<int> count() const = 0;
  /// Pictures a second, where the source tells.
  virtual std::optional<double> rate() const = 0;
};

/// Opens a video file, a folder of pictures (PNG, JPEG, BMP, TIFF, PGM, PPM; in the order of the
/// last number in their names) or a TIFF of many pictures. `rate` [1/s] is taken in place of the
/// source's; one that tells none, as a folder, has one picture a second. 16-bit samples of PNG and
/// TIFF are numbers of `depth` bits, 8 to 16, by default as many as the first picture needs; all
/// pictures are scaled to 8 bits alike, and what is larger becomes white. Throws InputError
/// "SOURCE: WHY" when there is no picture or nothing that can be read.
std::unique_ptr<FrameSource> open_frames(const std::filesystem::path& source,
                                         std::optional<double> rate = std::nullopt,
                                         std::optional<int> depth = std::nullopt);

/// The channel of a picture in which robots are looked for.
enum class VideoChannel { grey, red, green, blue };
constexpr auto enum_names(VideoChannel) {
  return std::array<std::pair<VideoChannel, std::string_view>, 4>{{{VideoChannel::grey, "grey"},
                                                                   {VideoChannel::red, "red"},
                                                                   {VideoChannel::green, "green"},
                                                                   {VideoChannel::blue, "blue"}}};
}

/// One channel of a picture into `grey`, whose memory is used again; a grey picture is all its
/// channels.
void take_channel(const Image& picture, VideoChannel channel, Image& grey);

}  // namespace microswarm
