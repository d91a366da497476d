// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/image_header.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "microswarm/core/error.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm {
namespace {

using Bytes = std::span<const std::byte>;

[[noreturn]] void fail(std::string_view name, const std::string& why) {
  throw InputError(std::string(name) + ": " + why);
}

/// Unsigned number of `count` bytes at `at`, most significant first.
std::uint32_t big_endian(Bytes bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (const std::byte b : bytes.subspan(at, count))
    value = value << 8 | std::to_integer<std::uint32_t>(b);
  return value;
}

std::uint32_t little_endian(Bytes bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  while (count-- > 0) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + count]);
  return value;
}

bool starts_with(Bytes bytes, std::string_view text) {
  return bytes.size() >= text.size() &&
         std::equal(text.begin(), text.end(), bytes.begin(),
                    [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

// --- PNG: a signature, then chunks of length, type, data, checksum (ISO/IEC 15948) ---------------

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// CRC-32 of ISO 3309, as in PNG chunks.
std::uint32_t checksum(Bytes bytes) {
  static constexpr auto table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < t.size(); ++i) {
      t[i] = i;
      for (int bit = 0; bit < 8; ++bit) t[i] = t[i] & 1 ? 0xedb88320U ^ t[i] >> 1 : t[i] >> 1;
    }
    return t;
  }();
  std::uint32_t crc = ~0U;
  for (const std::byte b : bytes)
    crc = table[(crc ^ std::to_integer<std::uint32_t>(b)) & 255] ^ crc >> 8;
  return ~crc;
}

struct Chunk {
  Bytes all;   ///< including length, type and checksum
  Bytes type;  ///< four letters
  Bytes data;
};

/// Calls visit(chunk) for each complete chunk until it returns false; false if the bytes end first.
template <class Visit>
bool for_each_chunk(Bytes bytes, Visit&& visit) {
  std::size_t at = png_signature.size();
  while (bytes.size() - at >= 12) {
    const std::size_t length = big_endian(bytes, at, 4);
    if (length > bytes.size() - at - 12) return false;
    if (!visit(Chunk{bytes.subspan(at, length + 12), bytes.subspan(at + 4, 4),
                     bytes.subspan(at + 8, length)}))
      return true;
    at += length + 12;
  }
  return false;
}

/// Bytes of one row before compression.
std::int64_t png_row_bytes(Bytes ihdr) {
  static constexpr std::array<int, 7> samples{1, 0, 3, 1, 2, 0, 4};  // by colour type
  const std::int64_t width = big_endian(ihdr, 0, 4);
  const std::int64_t depth = big_endian(ihdr, 8, 1);
  const std::size_t type = big_endian(ihdr, 9, 1);
  return type < samples.size() ? (width * samples[type] * depth + 7) / 8 : 0;
}

ImageHeader check_png(Bytes bytes, std::string_view name) {
  ImageHeader header;
  Bytes ihdr;
  std::int64_t compressed = 0;
  bool damaged = false;
  const bool whole = for_each_chunk(bytes, [&](const Chunk& chunk) {
    damaged |= checksum(chunk.all.subspan(4, chunk.all.size() - 8)) !=
               big_endian(chunk.all, chunk.all.size() - 4, 4);
    if (starts_with(chunk.type, "IHDR") && chunk.data.size() == 13 && ihdr.empty())
      ihdr = chunk.data;
    if (starts_with(chunk.type, "IDAT")) compressed += static_cast<std::int64_t>(chunk.data.size());
    return !damaged && !starts_with(chunk.type, "IEND");
  });
  if (ihdr.empty() && whole) fail(name, "damaged PNG: no header");
  if (!ihdr.empty()) {
    header.width = big_endian(ihdr, 0, 4);
    header.height = big_endian(ihdr, 4, 4);
    header.grey = big_endian(ihdr, 9, 1) == 0 || big_endian(ihdr, 9, 1) == 4;
    check_image_size(header.width, header.height, name);
  }
  if (damaged) fail(name, "damaged PNG: a checksum is wrong");
  if (!whole) fail(name, "truncated PNG: it ends before its IEND chunk");
  // Deflate compresses by a factor of at most 1032.
  if (compressed * 1032 < png_row_bytes(ihdr) * header.height)
    fail(name, "truncated PNG: too little data for its size");
  return header;
}

// --- JPEG: segments that start with a marker FF xx (ITU-T T.81, annex B) -------------------------

bool is_frame_header(std::uint32_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}
bool stands_alone(std::uint32_t marker) { return marker == 0x01 || (marker & 0xf8) == 0xd0; }

/// Next marker at or after `at`. In entropy-coded data, FF 00 and restarts are not markers.
std::size_t find_marker(Bytes bytes, std::size_t at) {
  for (; at + 1 < bytes.size(); ++at) {
    if (bytes[at] != std::byte{0xff}) continue;
    const auto next = std::to_integer<std::uint32_t>(bytes[at + 1]);
    if (next != 0 && next != 0xff && !stands_alone(next)) return at;
  }
  return bytes.size();
}

bool is_huffman_frame(std::uint32_t marker) { return marker <= 0xc2; }

/// Rejects data that cannot be complete or would take very long to decode.
void check_jpeg_data(const ImageHeader& header, std::int64_t scans, std::uint32_t frame,
                     std::int64_t bytes, std::string_view name) {
  const std::int64_t pixels = header.width * header.height;
  if (scans == 0) fail(name, "damaged JPEG: no picture in it");
  // A block of 8 × 8 pixels takes at least one bit.
  if (is_huffman_frame(frame) && bytes * 8 * 64 < pixels)
    fail(name, "truncated JPEG: too little data for its size");
  if (scans * pixels > 16 * max_image_pixels)
    fail(name, std::to_string(scans) + " scans, too many for a JPEG of its size");
}

ImageHeader check_jpeg(Bytes bytes, std::string_view name) {
  ImageHeader header{ImageKind::jpeg};
  std::int64_t scans = 0;
  std::uint32_t frame = 0;
  std::size_t at = find_marker(bytes, 2);
  while (at + 1 < bytes.size()) {
    const auto marker = std::to_integer<std::uint32_t>(bytes[at + 1]);
    if (marker == 0xd9) {
      check_jpeg_data(header, scans, frame, static_cast<std::int64_t>(at), name);
      return header;
    }
    if (bytes.size() - at < 4) break;
    const std::size_t length = big_endian(bytes, at + 2, 2);
    if (length < 2) fail(name, "damaged JPEG: a segment of " + std::to_string(length) + " bytes");
    if (length > bytes.size() - at - 2) break;
    if (is_frame_header(marker) && length >= 8) {
      if (frame) fail(name, "damaged JPEG: two frames");
      frame = marker;
      header.height = big_endian(bytes, at + 5, 2);
      header.width = big_endian(bytes, at + 7, 2);
      header.grey = big_endian(bytes, at + 9, 1) == 1;
      check_image_size(header.width, header.height, name);
    }
    if (marker == 0xda && frame) ++scans;
    at = find_marker(bytes, at + 2 + length);
  }
  fail(name, "truncated JPEG: it ends before its end-of-image marker");
}

// --- BMP: file header, size of the info header, then little-endian fields ------------------------

ImageHeader check_bmp(Bytes bytes, std::string_view name) {
  if (bytes.size() < 26) fail(name, "truncated BMP: no header");
  const std::size_t pixels = little_endian(bytes, 10, 4);
  const bool old = little_endian(bytes, 14, 4) == 12;
  if (bytes.size() < (old ? 26U : 54U)) fail(name, "truncated BMP: no header");
  const auto field = [&](std::size_t at) {
    return static_cast<std::int64_t>(static_cast<std::int32_t>(little_endian(bytes, at, 4)));
  };
  ImageHeader header{ImageKind::bmp};
  header.width = old ? little_endian(bytes, 18, 2) : field(18);
  header.height = old ? little_endian(bytes, 20, 2) : std::abs(field(22));
  const std::int64_t bits = little_endian(bytes, old ? 24 : 28, 2);
  const std::uint32_t compression = old ? 0 : little_endian(bytes, 30, 4);
  check_image_size(header.width, header.height, name);
  if (compression != 0 && compression != 3)
    fail(name, "compressed BMP: only plain pixels are read");
  if (bits != 1 && bits != 4 && bits != 8 && bits != 16 && bits != 24 && bits != 32)
    fail(name, "damaged BMP: " + std::to_string(bits) + " bits a pixel");
  const std::int64_t needed = (header.width * bits + 31) / 32 * 4 * header.height;
  if (pixels > bytes.size() || static_cast<std::int64_t>(bytes.size() - pixels) < needed)
    fail(name, "truncated BMP: " + std::to_string(needed) + " bytes of pixels expected");
  return header;
}

}  // namespace

void check_image_size(std::int64_t width, std::int64_t height, std::string_view name,
                      std::string_view unit) {
  const std::string size =
      std::to_string(width) + " × " + std::to_string(height) + " " + std::string(unit);
  if (width < 1 || height < 1) fail(name, size + ", at least 1 × 1");
  if (width > max_image_side || height > max_image_side)
    fail(name, size + ", at most " + std::to_string(max_image_side) + " a side");
  if (width * height > max_image_pixels)
    fail(name, size + ", at most " + std::to_string(max_image_pixels / 1'000'000) + " million");
}

ImageHeader check_image(Bytes bytes, std::string_view name) {
  if (bytes.empty()) fail(name, "empty file");
  if (starts_with(bytes, png_signature)) return check_png(bytes, name);
  if (starts_with(bytes, "\xff\xd8")) return check_jpeg(bytes, name);
  if (starts_with(bytes, "BM")) return check_bmp(bytes, name);
  if (bytes.size() > 2 && bytes[0] == std::byte{'P'} && bytes[1] >= std::byte{'1'} &&
      bytes[1] <= std::byte{'6'})
    return {.kind = ImageKind::pnm};
  fail(name, "not an image (PNG, JPEG, BMP, PGM, PPM or PBM)");
}

std::string pixel_chunks(Bytes png) {
  static constexpr std::array<std::string_view, 5> needed{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  std::string out(png_signature);
  for_each_chunk(png, [&](const Chunk& chunk) {
    for (const std::string_view type : needed)
      if (starts_with(chunk.type, type))
        out.append(reinterpret_cast<const char*>(chunk.all.data()), chunk.all.size());
    return !starts_with(chunk.type, "IEND");
  });
  return out;
}

}  // namespace microswarm
