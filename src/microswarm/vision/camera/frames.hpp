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

namespace microswarm::vision {

/// A picture of a video.
struct VideoFrame {
  int index = 0;           ///< from 0
  double t = 0;            ///< time since the first [s]
  formats::Image picture;  ///< grey or colour
};

/// A sequence of pictures of one size: a video, a folder, a camera. Derive from it to add a source.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// Reads the next picture into `frame`, reusing its memory; false at the end, and from the first
  /// picture on that cannot be read or differs in size. Throws InputError "SOURCE: WHY" if already
  /// the first one cannot be read.
  virtual bool next(VideoFrame& frame) = 0;
  /// Why the source ended before its last picture, "SOURCE: WHY"; empty if it did not.
  virtual std::string why_ended() const { return {}; }
  /// Number of pictures, if known in advance; a video file may hold fewer.
  virtual std::optional<int> count() const = 0;
  /// Frame rate [Hz], if the source reports it.
  virtual std::optional<double> rate() const = 0;
};

/// Opens a video file, a folder of pictures (PNG, JPEG, BMP, TIFF, PGM, PPM; in the order of the
/// last number in their names) or a TIFF of many pictures. `rate` [1/s] overrides the source's; the
/// default of a source without a rate, such as a folder, is 1/s. 16-bit samples of PNG and TIFF are
/// numbers of `depth` bits, 8 to 16, by default as many as the first picture needs; all pictures
/// are scaled to 8 bits by the same factor, and larger values become white. Throws InputError
/// "SOURCE: WHY" if there is no readable picture.
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

/// Copies one channel of a picture into `grey`, reusing its memory; a grey picture serves as each
/// channel.
void take_channel(const formats::Image& picture, VideoChannel channel, formats::Image& grey);

}  // namespace microswarm::vision
