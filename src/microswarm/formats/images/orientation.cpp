// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/orientation.hpp"

#include <libexif/exif-data.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "microswarm/core/fields/overloaded.hpp"

namespace microswarm::formats {
namespace {

/// Place of the first row and column of each orientation.
struct Turn {
  bool transposed, from_right, from_bottom;  ///< the latter two of the stored picture
};
constexpr Turn turns[] = {{false, false, false}, {false, true, false}, {false, true, true},
                          {false, false, true},  {true, false, false}, {true, false, true},
                          {true, true, true},    {true, true, false}};

template <class Sample>
void turn_samples(std::vector<Sample>& samples, int& width, int& height, int channels,
                  const Turn& turn) {
  const int w = width, h = height;
  const int shown_w = turn.transposed ? h : w, shown_h = turn.transposed ? w : h;
  const auto n = static_cast<std::size_t>(channels);
  std::vector<Sample> shown(samples.size());
  auto* out = shown.data();
  for (int y = 0; y < shown_h; ++y)
    for (int x = 0; x < shown_w; ++x, out += n) {
      int column = turn.transposed ? y : x, row = turn.transposed ? x : y;
      if (turn.from_right) column = w - 1 - column;
      if (turn.from_bottom) row = h - 1 - row;
      const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(w) +
                      static_cast<std::size_t>(column);
      std::copy_n(&samples[at * n], n, out);
    }
  samples = std::move(shown);
  width = shown_w;
  height = shown_h;
}

}  // namespace

int exif_orientation(std::span<const std::byte> jpeg_or_exif) {
  struct Unref {
    void operator()(ExifData* data) const { exif_data_unref(data); }
  };
  const std::unique_ptr<ExifData, Unref> exif(exif_data_new());
  if (!exif) return 1;
  exif_data_unset_option(exif.get(), EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
  exif_data_load_data(exif.get(), reinterpret_cast<const unsigned char*>(jpeg_or_exif.data()),
                      static_cast<unsigned>(jpeg_or_exif.size()));
  const ExifEntry* entry = exif_content_get_entry(exif->ifd[EXIF_IFD_0], EXIF_TAG_ORIENTATION);
  if (!entry || entry->format != EXIF_FORMAT_SHORT || entry->components != 1 || entry->size < 2)
    return 1;
  const int told = exif_get_short(entry->data, exif_data_get_byte_order(exif.get()));
  return told >= 1 && told <= 8 ? told : 1;
}

void orient(DecodedImage& picture, int orientation) {
  if (orientation < 2 || orientation > 8) return;
  const Turn& turn = turns[orientation - 1];
  const Overloaded turn_kind(
      [&](Image& plain) {
        turn_samples(plain.pixels, plain.width, plain.height, plain.channels, turn);
      },
      [&](OneOf<DeepImage, RealImage> auto& other) {
        turn_samples(other.samples, other.width, other.height, other.channels, turn);
      });
  std::visit(turn_kind, picture);
}

}  // namespace microswarm::formats
