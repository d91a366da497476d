// SPDX-License-Identifier: Apache-2.0
// Replaces what reads PNG, JPEG, BMP, TIFF and GIF in a build without MICROSWARM_PICTURES. Netpbm
// is read.
#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/images/codecs.hpp"
#include "microswarm/formats/images/tiff.hpp"

namespace microswarm::formats {
namespace {

[[noreturn]] void fail(std::string_view name) {
  throw InputError(std::string(name),
                   "not PGM, PPM or PBM: this build reads no other pictures; the program does");
}

}  // namespace

struct TiffPages::File {};

TiffPages::TiffPages(std::span<const std::byte>, std::string_view name) { fail(name); }
TiffPages::~TiffPages() = default;
DecodedImage TiffPages::next() { fail(name_); }

bool is_tiff(std::span<const std::byte>) { return false; }
bool is_png(std::span<const std::byte>) { return false; }

DecodedImage decode_pixels(std::span<const std::byte>, std::string_view name) { fail(name); }

std::vector<std::uint8_t> transparency(std::span<const std::byte>, std::string_view) { return {}; }

}  // namespace microswarm::formats
