// SPDX-License-Identifier: Apache-2.0
// Header of a TIFF's page; for its reader only.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <string_view>

#include "microswarm/formats/images/tiff_colours.hpp"
#include "microswarm/formats/images/tiff_samples.hpp"

namespace microswarm::formats::tiff {

/// Header of a page.
struct Page {
  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT;
  std::uint16_t planes = PLANARCONFIG_CONTIG, photometric = PHOTOMETRIC_MINISBLACK;
  std::uint16_t orientation = 0, compression = COMPRESSION_NONE;  // 0: no tag
  PixelSamples pixel{};

  bool is_whole() const { return format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID; }
  bool is_grey() const {
    return photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_MINISWHITE;
  }
  /// Whether what its samples mean is known here, and not by libtiff alone.
  bool is_plain() const {
    return is_grey() || photometric == PHOTOMETRIC_RGB || photometric == PHOTOMETRIC_PALETTE ||
           (photometric == PHOTOMETRIC_SEPARATED && inks == INKSET_CMYK);
  }
  /// The largest whole sample.
  std::uint32_t full() const { return (std::uint32_t{1} << bits) - 1; }
  std::uint16_t inks = INKSET_CMYK;
};

/// Samples of a colour by the photometric interpretation.
inline int colours_of(const Page& p) {
  if (p.photometric == PHOTOMETRIC_SEPARATED) return 4;
  return p.is_grey() || p.photometric == PHOTOMETRIC_PALETTE ? 1 : 3;
}

/// Name of the samples that become a RealImage; empty for others.
inline std::string_view real_kind(const Page& p) {
  if (p.format == SAMPLEFORMAT_IEEEFP && p.bits == 32) return "32-bit float";
  if (p.format == SAMPLEFORMAT_IEEEFP && p.bits == 64) return "64-bit float";
  if (p.format == SAMPLEFORMAT_INT && p.bits == 8) return "signed 8-bit";
  if (p.format == SAMPLEFORMAT_INT && p.bits == 16) return "signed 16-bit";
  if (p.format == SAMPLEFORMAT_INT && p.bits == 32) return "signed 32-bit";
  if (p.is_whole() && p.bits == 32) return "32-bit";
  return {};
}

/// Calls `with` with the reader of samples of this kind.
template <class With>
bool with_real_reader(const Page& p, With&& with) {
  if (p.format == SAMPLEFORMAT_IEEEFP)
    return p.bits == 32 ? with(PlainSamples<float>()) : with(PlainSamples<double>());
  if (p.format != SAMPLEFORMAT_INT) return with(PlainSamples<std::uint32_t>());
  if (p.bits == 8) return with(PlainSamples<std::int8_t>());
  return p.bits == 16 ? with(PlainSamples<std::int16_t>()) : with(PlainSamples<std::int32_t>());
}

}  // namespace microswarm::formats::tiff
