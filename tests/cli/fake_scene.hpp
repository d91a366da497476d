// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the cameras that are not there show, and how tests say what they are like: FAKE_CAMERA is
// "device=/dev/video90 unplug=20".

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace fake {

inline std::string word_of(const char* key, const char* otherwise) {
  const char* const all = std::getenv("FAKE_CAMERA");
  const std::string text = all ? " " + std::string(all) + " " : " ";
  const std::string sought = " " + std::string(key) + "=";
  const std::size_t at = text.find(sought);
  if (at == std::string::npos) return otherwise;
  const std::size_t from = at + sought.size();
  return text.substr(from, text.find(' ', from) - from);
}
inline int number_of(const char* key, int otherwise) {
  return std::atoi(word_of(key, std::to_string(otherwise).c_str()).c_str());
}

/// Pixels of the PGM that `scene` names, which may change; empty without one of this size.
inline std::vector<std::uint8_t> scene_pixels(std::size_t count) {
  std::vector<std::uint8_t> pixels;
  const std::string name = word_of("scene", "");
  std::FILE* const file = name.empty() ? nullptr : std::fopen(name.c_str(), "rb");
  if (!file) return pixels;
  std::fseek(file, 0, SEEK_END);
  const long size = std::ftell(file);
  if (size >= static_cast<long>(count)) {
    pixels.resize(count);
    std::fseek(file, -static_cast<long>(count), SEEK_END);
    if (std::fread(pixels.data(), 1, count, file) != count) pixels.clear();
  }
  std::fclose(file);
  return pixels;
}

/// Grey 120, brighter by the gain, with a dark disc in the middle and a bit of noise; or the scene.
inline std::vector<std::uint8_t> grey_picture(int width, int height, int gain, int pictures) {
  std::vector<std::uint8_t> grey(static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
  const std::vector<std::uint8_t> scene = scene_pixels(grey.size());
  std::uint32_t noise = 12345u + static_cast<std::uint32_t>(pictures);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      noise = noise * 1664525u + 1013904223u;
      const std::size_t at = static_cast<std::size_t>(y) * width + x;
      if (scene.size() == grey.size()) {
        grey[at] = static_cast<std::uint8_t>(scene[at] + (noise >> 31));
        continue;
      }
      const int dx = x - width / 2, dy = y - height / 2;
      grey[at] = static_cast<std::uint8_t>((dx * dx + dy * dy < 25 * 25 ? 60 : 120 + gain) +
                                           static_cast<int>(noise >> 30) - 1);
    }
  return grey;
}

}  // namespace fake
