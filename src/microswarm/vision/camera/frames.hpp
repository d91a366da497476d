// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm::vision {

/// A picture of a video.
struct VideoFrame {
  int index = 0;             ///< from 0
  double t = 0;              ///< time since the first, or as a table of times says [s]
  formats::Image picture{};  ///< grey or colour
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
  /// Mean frame rate [Hz], if the source reports it.
  virtual std::optional<double> rate() const = 0;
  /// Side of a pixel [µm], if the source reports it.
  virtual std::optional<double> um_per_px() const { return std::nullopt; }
  /// Assumptions and omissions so far, "SOURCE: WHAT" each. Lines are only added.
  virtual std::vector<std::string> notes() const { return {}; }
};

/// Options of `open_frames`.
struct FrameOptions {
  std::optional<double> rate = std::nullopt;        ///< [1/s], instead of the source's times
  std::optional<int> depth = std::nullopt;          ///< bits, 8 to 16, used of 16-bit samples
  std::filesystem::path times = {};                 ///< table of the pictures' times; empty: none
  std::optional<int> stack_channel = std::nullopt;  ///< of a TIFF that holds several, from 1
  std::optional<int> slice = std::nullopt;          ///< of a TIFF that holds several, from 1
};

/// Opens a video file, a folder of pictures (PNG, JPEG, BMP, TIFF, PGM, PPM; in the natural order
/// of their names), a TIFF of many pictures or an animated PNG. Times are, in this order: those of
/// the table `times` (`parse_frame_times`); `rate`; those that VideoRecorder wrote into a table
/// beside the video; those in the video's container, or in a TIFF of ImageJ or OME; one picture a
/// second. Where names in a folder differ by one number, its gaps are gaps in time. Samples of more
/// than 8 bits are scaled as `scale_of` says for the first picture, or as numbers of `depth` bits.
/// Throws InputError "SOURCE: WHY" if there is no readable picture, and for a stack of several
/// channels, or of several slices at several times, of which none is chosen.
std::unique_ptr<FrameSource> open_frames(const std::filesystem::path& source,
                                         const FrameOptions& options);
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
