// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/images/codecs.hpp"
#include "microswarm/formats/images/pnm.hpp"
#include "microswarm/formats/images/samples.hpp"
#include "microswarm/formats/images/tiff.hpp"

namespace microswarm::formats {
namespace {

constexpr std::uint64_t max_file_bytes = 512ULL << 20;

bool is_pnm(std::span<const std::byte> bytes) {
  return bytes.size() > 2 && bytes[0] == std::byte{'P'} && bytes[1] >= std::byte{'1'} &&
         bytes[1] <= std::byte{'6'};
}

}  // namespace

void check_image_size(std::int64_t width, std::int64_t height, std::string_view name,
                      std::string_view unit) {
  const auto refuse = [&](const std::string& limit) {
    throw InputError(std::string(name), fmt::format("{} × {} {}, {}", width, height, unit, limit));
  };
  if (width < 1 || height < 1) refuse("at least 1 × 1");
  if (width > max_image_side || height > max_image_side)
    refuse(fmt::format("at most {} a side", max_image_side));
  if (width * height > max_image_pixels)
    refuse(fmt::format("at most {} million", max_image_pixels / 1'000'000));
}

Image decode_image(std::span<const std::byte> bytes, std::string_view name, int depth) {
  if (is_pnm(bytes)) return decode_pnm(bytes, name);
  DecodedImage decoded = decode_pixels(bytes, name);
  const bool real = std::holds_alternative<RealImage>(decoded);
  const GreyScale scale = real ? scale_of(decoded) : GreyScale::of_depth(depth);
  Image image;
  take_pixels(std::move(decoded), scale, image);
  return image;
}

Image read_image(const std::filesystem::path& path, int depth) {
  const std::string bytes = read_file(path, max_file_bytes);
  return decode_image(std::as_bytes(std::span(bytes.data(), bytes.size())), path.string(), depth);
}

bool has_image_extension(const std::filesystem::path& path) {
  return std::ranges::find(image_extensions, lower_extension(path)) != image_extensions.end();
}

std::vector<std::uint8_t> read_transparency(const std::filesystem::path& path) {
  const std::string bytes = read_file(path, max_file_bytes);
  return transparency(std::as_bytes(std::span(bytes.data(), bytes.size())), path.string());
}

DecodedImage read_stored(const std::filesystem::path& path) {
  const std::string file = read_file(path, max_file_bytes);
  const auto bytes = std::as_bytes(std::span(file.data(), file.size()));
  if (is_pnm(bytes)) return decode_pnm(bytes, path.string());
  return decode_pixels(bytes, path.string());
}

ReadPicture read_picture(const std::filesystem::path& path) {
  const std::string file = read_file(path, max_file_bytes);
  const auto bytes = std::as_bytes(std::span(file.data(), file.size()));
  const std::string name = path.string();
  ReadPicture picture;
  const auto note = [&](const std::string& text) {
    if (!text.empty()) picture.notes.push_back(name + ": " + text);
  };
  if (is_pnm(bytes)) {
    picture.image = decode_pnm(bytes, name);
    return picture;
  }
  std::optional<DecodedImage> decoded;
  if (is_tiff(bytes)) {
    TiffPages pages(bytes, name);
    if (pages.count() > 1)
      note(fmt::format("holds {} pictures, the first is taken", pages.count()));
    picture.um_per_px = pages.description().um_per_px;
    if (const int channels = pages.description().pixel_channels; channels > 1)
      note(fmt::format("its pixels have {} channels that are no colours, the first is taken",
                       channels));
    for (const std::string& text : pages.notes()) note(text);
    decoded = pages.next();
  } else {
    decoded = decode_pixels(bytes, name);
  }
  const GreyScale scale = scale_of(*decoded);
  picture.black = scale.black;
  picture.white = scale.white;
  note(scale_note(*decoded, scale));
  note(no_number_note(*decoded));
  take_pixels(*std::move(decoded), scale, picture.image);
  return picture;
}

Image read_photograph(const std::filesystem::path& path) { return read_picture(path).image; }

Image to_grey(const Image& image) {
  if (image.channels == 1) return image;
  Image grey{image.width, image.height, 1, {}};
  grey.pixels.resize(grey.index(0, image.height));
  for (std::size_t i = 0; i < grey.pixels.size(); ++i) {
    const std::uint8_t* rgb = &image.pixels[3 * i];
    grey.pixels[i] =
        static_cast<std::uint8_t>((299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] + 500) / 1000);
  }
  return grey;
}

}  // namespace microswarm::formats
