// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/pnm.hpp"

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {
namespace {

constexpr int highest_maximum = 65535;

/// Reads numbers and samples in sequence.
class PnmReader {
 public:
  PnmReader(std::span<const std::byte> bytes, std::string_view name)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name_(name), at_(2) {}

  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(std::string(name_), why);
  }
  std::size_t left() const { return text_.size() - at_; }

  /// Next number, after blanks and comments; at most `limit`.
  int number(int limit, const char* what) {
    skip_blanks();
    if (at_ == text_.size()) fail("truncated: it ends before " + std::string(what));
    if (!is_digit(text_[at_])) fail("damaged: " + std::string(what) + " is not a number");
    int value = 0;
    for (; at_ < text_.size() && is_digit(text_[at_]); ++at_) {
      value = value * 10 + (text_[at_] - '0');
      if (value > limit) fail(std::string(what) + " is above " + std::to_string(limit));
    }
    return value;
  }
  /// One digit of a plain PBM, whose digits need no blanks between them.
  int bit() {
    skip_blanks();
    if (at_ == text_.size()) fail("truncated: it ends before its last pixel");
    if (text_[at_] != '0' && text_[at_] != '1') fail("damaged: a pixel is neither 0 nor 1");
    return text_[at_++] - '0';
  }
  /// Skips the single blank between the header and raw samples.
  void end_header() {
    if (left() == 0) fail("truncated: no pixels");
    ++at_;
  }
  int byte() { return static_cast<unsigned char>(text_[at_++]); }

 private:
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  void skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '#')
        while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n' && text_[at_ + 1] != '\r') ++at_;
      else if (c != ' ' && (c < '\t' || c > '\r'))
        return;
    }
  }

  std::string_view text_;
  std::string_view name_;
  std::size_t at_;
};

void read_bits(PnmReader& reader, bool plain, Image& image) {
  for (int row = 0; row < image.height; ++row) {
    int packed = 0;
    for (int column = 0; column < image.width; ++column) {
      if (!plain && column % 8 == 0) packed = reader.byte();
      const int bit = plain ? reader.bit() : packed >> (7 - column % 8) & 1;
      image.pixels[image.index(column, row)] = bit ? 0 : 255;  // 1 is black
    }
  }
}

void read_samples(PnmReader& reader, bool plain, int maximum, Image& image) {
  const bool wide = maximum > 255;
  for (std::uint8_t& pixel : image.pixels) {
    int value = 0;
    if (plain) {
      value = reader.number(maximum, "a sample");
    } else {
      value = reader.byte();
      if (wide) value = value << 8 | reader.byte();
      if (value > maximum) reader.fail("damaged: a sample is above " + std::to_string(maximum));
    }
    pixel = static_cast<std::uint8_t>((value * 255 + maximum / 2) / maximum);
  }
}

}  // namespace

Image decode_pnm(std::span<const std::byte> bytes, std::string_view name) {
  PnmReader reader(bytes, name);
  const int form = std::to_integer<int>(bytes[1]) - '0';
  const bool plain = form <= 3;
  const bool bits = form == 1 || form == 4;
  Image image;
  image.channels = form == 3 || form == 6 ? 3 : 1;
  image.width = reader.number(9'999'999, "the width");
  image.height = reader.number(9'999'999, "the height");
  check_image_size(image.width, image.height, name);
  const int maximum = bits ? 1 : reader.number(highest_maximum, "the maximum");
  if (maximum == 0) reader.fail("damaged: the maximum is 0");
  reader.end_header();

  const std::size_t samples = image.index(0, image.height);
  const std::size_t row_of_bits = (static_cast<std::size_t>(image.width) + 7) / 8;
  std::size_t needed = samples * (maximum > 255 ? 2 : 1);
  if (plain) needed = bits ? samples : 2 * samples - 1;
  if (form == 4) needed = row_of_bits * static_cast<std::size_t>(image.height);
  if (reader.left() < needed)
    reader.fail("truncated: " + std::to_string(needed) + " bytes of pixels expected, " +
                std::to_string(reader.left()) + " there");
  image.pixels.resize(samples);
  if (bits)
    read_bits(reader, plain, image);
  else
    read_samples(reader, plain, maximum, image);
  return image;
}

std::string encode_pnm(const Image& image) {
  std::string out = image.channels == 3 ? "P6\n" : "P5\n";
  out += std::to_string(image.width) + " " + std::to_string(image.height) + "\n255\n";
  out.append(reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size());
  return out;
}

}  // namespace microswarm::formats
