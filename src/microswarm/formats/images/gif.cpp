// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/gif.hpp"

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::formats {
namespace {

constexpr int max_colours = 255;  // besides the transparent one, which is 0

/// A rectangle of the picture, its end excluded [px].
struct ChangedArea {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

bool is_same(const Image& a, const Image& b, std::size_t i) {
  return std::equal(&a.pixels[i], &a.pixels[i] + 3, &b.pixels[i]);
}

/// Area that differs from the last picture; one pixel if none does.
ChangedArea changed_since(const Image& last, const Image& picture) {
  if (last.pixels.empty()) return {0, 0, picture.width, picture.height};
  ChangedArea area{picture.width, picture.height, 0, 0};
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column) {
      if (is_same(picture, last, picture.index(column, row))) continue;
      area = {std::min(area.left, column), std::min(area.top, row),
              std::max(area.right, column + 1), row + 1};
    }
  return area.right > 0 ? area : ChangedArea{0, 0, 1, 1};
}

/// Pixels as indices into a palette of 256, where 0 is transparent.
struct IndexedPixels {
  std::vector<GifByteType> indices;
  std::vector<GifColorType> colours{{}};
};

/// Pixels with the area's own colours; nothing if it has more than max_colours.
std::optional<IndexedPixels> with_own_colours(const Image& last, const Image& picture,
                                              const ChangedArea& area) {
  IndexedPixels pixels;
  std::unordered_map<std::uint32_t, GifByteType> places;
  for (int row = area.top; row < area.bottom; ++row)
    for (int column = area.left; column < area.right; ++column) {
      const std::size_t i = picture.index(column, row);
      if (!last.pixels.empty() && is_same(picture, last, i)) {
        pixels.indices.push_back(0);
        continue;
      }
      const std::uint8_t* rgb = &picture.pixels[i];
      const auto next = static_cast<GifByteType>(pixels.colours.size());
      const auto [place, is_new] = places.try_emplace(
          std::uint32_t{rgb[0]} << 16 | std::uint32_t{rgb[1]} << 8 | rgb[2], next);
      if (is_new && pixels.colours.size() > max_colours) return std::nullopt;
      if (is_new) pixels.colours.push_back({rgb[0], rgb[1], rgb[2]});
      pixels.indices.push_back(place->second);
    }
  return pixels;
}

IndexedPixels with_chosen_colours(const Image& last, const Image& picture,
                                  const ChangedArea& area) {
  const auto pixels =
      static_cast<std::size_t>(area.width()) * static_cast<std::size_t>(area.height());
  std::array<std::vector<GifByteType>, 3> channels;
  for (auto& channel : channels) channel.reserve(pixels);
  for (int row = area.top; row < area.bottom; ++row)
    for (int column = area.left; column < area.right; ++column)
      for (std::size_t c = 0; c < 3; ++c)
        channels[c].push_back(picture.pixels[picture.index(column, row) + c]);
  IndexedPixels chosen;
  chosen.indices.resize(pixels);
  std::array<GifColorType, max_colours> colours{};
  int count = max_colours;
  if (GifQuantizeBuffer(static_cast<unsigned>(area.width()), static_cast<unsigned>(area.height()),
                        &count, channels[0].data(), channels[1].data(), channels[2].data(),
                        chosen.indices.data(), colours.data()) != GIF_OK)
    throw InputError("no colours could be chosen for a GIF");
  chosen.colours.insert(chosen.colours.end(), colours.begin(), colours.begin() + count);
  std::size_t n = 0;
  for (int row = area.top; row < area.bottom; ++row)
    for (int column = area.left; column < area.right; ++column, ++n) {
      const bool stays = !last.pixels.empty() && is_same(picture, last, picture.index(column, row));
      chosen.indices[n] = stays ? 0 : static_cast<GifByteType>(chosen.indices[n] + 1);
    }
  return chosen;
}

struct FreeColours {
  void operator()(ColorMapObject* map) const { GifFreeMapObject(map); }
};

}  // namespace

struct GifWriter::Parts {
  Parts(std::filesystem::path path, double pictures_a_second)
      : file(std::move(path)), rate(pictures_a_second) {
    int error = 0;
    gif = EGifOpenFileName(file.c_str(), false, &error);
    if (gif == nullptr) fail(error);
  }
  ~Parts() {
    if (gif != nullptr) EGifCloseFile(gif, nullptr);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  [[noreturn]] void fail(int error) const {
    const char* reason = GifErrorString(error);
    throw InputError(file.string(),
                     std::string("cannot write: ") + (reason != nullptr ? reason : "unknown"));
  }
  void check(int result) const {
    if (result != GIF_OK) fail(gif->Error);
  }
  void begin(const Image& picture) const;
  void put(const ChangedArea& area, IndexedPixels pixels) const;
  int delay() const;

  std::filesystem::path file;
  double rate;
  GifFileType* gif = nullptr;
  Image last;
  int pictures = 0;
};

void GifWriter::Parts::begin(const Image& picture) const {
  EGifSetGifVersion(gif, true);
  check(EGifPutScreenDesc(gif, picture.width, picture.height, 8, 0, nullptr));
  check(EGifPutExtensionLeader(gif, APPLICATION_EXT_FUNC_CODE));
  check(EGifPutExtensionBlock(gif, 11, "NETSCAPE2.0"));
  check(EGifPutExtensionBlock(gif, 3, "\x01\x00\x00"));  // repeated without limit
  check(EGifPutExtensionTrailer(gif));
}

/// Delay until the next picture [1/100 s], rounded so that the total duration is kept.
int GifWriter::Parts::delay() const {
  const auto begins = [this](int picture) { return std::lround(100 * picture / rate); };
  return static_cast<int>(std::min(begins(pictures + 1) - begins(pictures), 65535L));
}

void GifWriter::Parts::put(const ChangedArea& area, IndexedPixels pixels) const {
  const GraphicsControlBlock control{.DisposalMode = DISPOSE_DO_NOT,
                                     .UserInputFlag = false,
                                     .DelayTime = delay(),
                                     .TransparentColor = 0};
  std::array<GifByteType, 4> bytes{};
  EGifGCBToExtension(&control, bytes.data());
  check(EGifPutExtension(gif, GRAPHICS_EXT_FUNC_CODE, bytes.size(), bytes.data()));
  // giflib requires a power of two, at least two.
  pixels.colours.resize(std::max<std::size_t>(2, std::bit_ceil(pixels.colours.size())));
  const std::unique_ptr<ColorMapObject, FreeColours> colours(
      GifMakeMapObject(static_cast<int>(pixels.colours.size()), pixels.colours.data()));
  if (!colours) throw std::bad_alloc();
  check(EGifPutImageDesc(gif, area.left, area.top, area.width(), area.height(), false,
                         colours.get()));
  for (int row = 0; row < area.height(); ++row)
    check(EGifPutLine(gif, &pixels.indices[static_cast<std::size_t>(row * area.width())],
                      area.width()));
}

GifWriter::GifWriter(const std::filesystem::path& file, double rate)
    : parts_(std::make_unique<Parts>(file, rate)) {
  assert(rate > 0 && rate <= max_gif_rate);
}

GifWriter::~GifWriter() = default;

void GifWriter::add(const Image& picture) {
  Parts& p = *parts_;
  assert(picture.channels == 3 && picture.width <= 0xffff && picture.height <= 0xffff);
  assert(p.pictures == 0 || p.last.pixels.size() == picture.pixels.size());
  if (p.pictures == 0) p.begin(picture);
  const ChangedArea area = changed_since(p.last, picture);
  std::optional<IndexedPixels> pixels = with_own_colours(p.last, picture, area);
  if (!pixels) pixels = with_chosen_colours(p.last, picture, area);
  p.put(area, *std::move(pixels));
  p.last = picture;
  ++p.pictures;
}

void GifWriter::finish() {
  int error = 0;
  if (EGifCloseFile(std::exchange(parts_->gif, nullptr), &error) != GIF_OK) parts_->fail(error);
}

}  // namespace microswarm::formats
