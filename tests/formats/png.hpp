// SPDX-License-Identifier: Apache-2.0
// Writes PNGs of any colour type and depth, byte by byte, with deflate blocks that only store.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace microswarm::test {

inline std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
          static_cast<char>(value >> 8), static_cast<char>(value)};
}

inline std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = ~0U;
  for (const char c : bytes) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320U : 0);
  }
  return ~crc;
}

inline std::string chunk(std::string_view type, std::string_view data) {
  std::string body(type);
  body += data;
  return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(crc32(body));
}

/// At most 65535 bytes as a zlib stream.
inline std::string stored(std::string_view raw) {
  const auto n = static_cast<std::uint16_t>(raw.size());
  std::string out = "\x78\x01\x01";
  for (const std::uint16_t word : {n, static_cast<std::uint16_t>(~n)})
    out += {static_cast<char>(word), static_cast<char>(word >> 8)};
  out += raw;
  std::uint32_t a = 1, b = 0;
  for (const char c : raw) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return out + big_endian(b << 16 | a);
}

enum ColourType : std::uint8_t { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgb_alpha = 6 };

inline std::string ihdr(std::uint32_t width, std::uint32_t height, int depth, ColourType colour) {
  std::string data = big_endian(width) + big_endian(height);
  data += {static_cast<char>(depth), static_cast<char>(colour), 0, 0, 0};
  return chunk("IHDR", data);
}

inline const std::string png_signature = "\x89PNG\r\n\x1a\n";

/// `rows` are the packed samples of each row after its filter byte 0; `extra` chunks come before.
inline std::string png(std::uint32_t width, std::uint32_t height, int depth, ColourType colour,
                       std::string_view rows, std::string_view extra = {}) {
  return png_signature + ihdr(width, height, depth, colour) + std::string(extra) +
         chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

}  // namespace microswarm::test
