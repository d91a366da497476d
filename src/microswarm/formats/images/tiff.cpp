// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/tiff.hpp"

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/images/orientation.hpp"
#include "microswarm/formats/images/tiff_file.hpp"
#include "microswarm/formats/images/tiff_page.hpp"

namespace microswarm::formats {
namespace {

constexpr int max_pages = 1'000'000;

}  // namespace

bool is_tiff(std::span<const std::byte> bytes) {
  constexpr std::array<std::string_view, 4> begins{
      std::string_view("II*\0", 4), std::string_view("MM\0*", 4), std::string_view("II+\0", 4),
      std::string_view("MM\0+", 4)};
  return std::ranges::any_of(begins, [&](std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
  });
}

TiffPages::TiffPages(const std::filesystem::path& file)
    : name_(file.string()), file_(std::make_unique<File>()) {
  file_->open([&](TIFFOpenOptions* options) { return TIFFOpenExt(name_.c_str(), "r", options); });
  count_pages();
}

TiffPages::TiffPages(std::span<const std::byte> bytes, std::string_view name)
    : name_(name), file_(std::make_unique<File>()) {
  file_->bytes = bytes;
  file_->open([&](TIFFOpenOptions* options) {
    return TIFFClientOpenExt(name_.c_str(), "r", file_.get(), File::read, File::write, File::seek,
                             File::close, File::size, File::map, File::unmap, options);
  });
  count_pages();
}

TiffPages::~TiffPages() = default;

void TiffPages::count_pages() {
  TIFF* const tiff = file_->tiff;
  if (!tiff) throw InputError(name_, "is no TIFF that can be read");
  const tiff::Page first = file_->page();
  description_ = file_->description(name_);
  description_.pixel_channels = first.pixel.channels;
  orientation_ = first.orientation;
  file_->errors = 0;
  count_ = static_cast<int>(std::min<std::uint64_t>(TIFFNumberOfDirectories(tiff), max_pages));
  if (count_ == 0) throw InputError(name_, "holds no picture");
  const bool is_cut = file_->errors > 0;
  const int told = description_.images;
  if (told > 1 && count_ == 1 && may_be_in_row(is_cut)) {
    const auto& row = file_->in_row;
    const std::uint64_t size = file_->file_size();
    const std::uint64_t whole = size > row->begin ? (size - row->begin) / row->size : 0;
    count_ = static_cast<int>(std::clamp<std::uint64_t>(whole, 1, static_cast<unsigned>(told)));
    if (is_cut && count_ == told)
      notes_.push_back("it is cut behind its pictures: they are read as they follow the first one");
  } else if (is_cut) {
    why_fewer_ = fmt::format(
        "{}: the list of its pictures breaks off after {}: it is cut or damaged", name_, count_);
  }
  if (why_fewer_.empty() && count_ < told)
    why_fewer_ =
        fmt::format("{}: {} states {} pictures in it, {} are there{}", name_, description_.software,
                    told, count_, is_cut ? ": it is cut or damaged" : "");
  if (first.pixel.unknown > 0)
    notes_.push_back(
        fmt::format("of the {} samples of a pixel {} are left out: the file does not say what "
                    "they are",
                    first.samples, first.pixel.unknown));
  if (file_->is_of_bools())
    notes_.push_back(
        "its 1 is black (WhiteIsZero), as tifffile stores true and false: what was "
        "true is dark");
}

/// Whether the pages follow the first one without directories, whose place is then kept. If the
/// file is cut, the second directory must begin behind them all.
bool TiffPages::may_be_in_row(bool is_cut) {
  File& f = *file_;
  if (!is_cut && !description_.one_directory) return false;
  f.in_row = f.find_row();
  if (f.in_row && is_cut &&
      f.second_directory() <
          f.in_row->begin + f.in_row->size * static_cast<std::uint64_t>(description_.images))
    f.in_row.reset();
  return f.in_row.has_value();
}

void TiffPages::take_channel(int channel) { file_->channel = channel; }

void TiffPages::go_to(int page) { next_ = page; }

/// Goes to the page `next_`. Directories form a list: those behind the farthest so far are read one
/// after the other, those before it are found again by their places.
void TiffPages::step() {
  File& f = *file_;
  if (f.in_row) {
    f.page_in_row = next_;
    return;
  }
  TIFF* const tiff = f.tiff;
  const auto fail = [&](std::size_t page) {
    throw InputError(name_, fmt::format("picture {} is damaged, or the file ends early", page));
  };
  if (f.places.empty()) f.places.push_back(TIFFCurrentDirOffset(tiff));
  const auto page = static_cast<std::size_t>(next_);
  const std::size_t known = std::min(page, f.places.size() - 1);
  if (TIFFCurrentDirOffset(tiff) != f.places[known] &&
      TIFFSetSubDirectory(tiff, f.places[known]) != 1)
    fail(known);
  while (f.places.size() <= page) {
    if (!TIFFReadDirectory(tiff)) fail(f.places.size());
    f.places.push_back(TIFFCurrentDirOffset(tiff));
  }
}

DecodedImage TiffPages::next() {
  step();
  const tiff::Page page = file_->page();
  check_image_size(page.width, page.height, name_);
  const bool real = !tiff::real_kind(page).empty();
  if (page.samples < 1 || page.samples > 16)
    throw InputError(name_, fmt::format("picture {} has {} samples a pixel, at most 16 are read",
                                        next_, page.samples));
  if (!real && (!page.is_whole() || page.bits > 16))
    throw InputError(
        name_,
        fmt::format(
            "picture {} has {} samples of {} bits, which are not read: save it with 8 or 16 bits, "
            "or as 32-bit float",
            next_,
            page.format == SAMPLEFORMAT_IEEEFP ? "float"
            : page.is_whole()                  ? "whole"
                                               : "signed or complex",
            page.bits));
  const bool is_colour = page.is_grey() || page.photometric == PHOTOMETRIC_RGB;
  require_known(
      (real ? is_colour : page.is_plain()) || (!real && page.bits <= 8 && page.pixel.alpha < 0),
      page.pixel.channels);
  const auto decode = [&] {
    if (!file_->in_row && !file_->is_all_there()) return std::optional<DecodedImage>();
    if (real) return file_->decode_real(page);
    const bool is_simple = page.pixel.alpha < 0 && page.pixel.channels == 1 && !file_->in_row;
    return page.bits > 8 || !is_simple ? file_->decode_whole(page) : file_->decode_8(page);
  };
  std::optional<DecodedImage> picture = decode();
  if (!picture)
    throw InputError(name_, fmt::format("picture {} is damaged, or the file ends early", next_));
  orient(*picture, page.orientation ? page.orientation : orientation_);
  ++next_;
  return *std::move(picture);
}

/// Refuses the next page if its colours are not `known`, or fewer channels than the one chosen.
void TiffPages::require_known(bool known, int channels) const {
  if (!known)
    throw InputError(
        name_,
        fmt::format(
            "picture {} has colours of a kind that is not read with its samples: save it as RGB or "
            "grey",
            next_));
  if (file_->channel >= channels)
    throw InputError(name_, fmt::format("picture {} has {} channel{}, number {} is chosen", next_,
                                        channels, channels == 1 ? "" : "s", file_->channel + 1));
}

std::vector<std::uint8_t> TiffPages::transparency() {
  step();
  const tiff::Page page = file_->page();
  check_image_size(page.width, page.height, name_);
  const bool is_read = !tiff::real_kind(page).empty() || (page.is_whole() && page.bits <= 16);
  if (!is_read || !page.is_plain()) return {};
  auto clear = file_->transparency(page);
  if (!clear)
    throw InputError(name_, fmt::format("picture {} is damaged, or the file ends early", next_));
  if (clear->empty()) return {};
  DecodedImage picture =
      Image{static_cast<int>(page.width), static_cast<int>(page.height), 1, *std::move(clear)};
  orient(picture, page.orientation ? page.orientation : orientation_);
  return std::get<Image>(std::move(picture)).pixels;
}

}  // namespace microswarm::formats
