// SPDX-License-Identifier: Apache-2.0
// Writes TIFFs of given samples with the tags that tests are about.
#pragma once

#include <gtest/gtest.h>
#include <tiffio.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace microswarm::test {

/// Tags of the pages; the size of a sample is that of its type.
struct TiffTags {
  int format = SAMPLEFORMAT_UINT;
  int samples = 1;
  int orientation = 0;        ///< 0: no tag
  std::string description{};  ///< of the first page
  float resolution = 0;       ///< pixels a unit, of the first page
  const char* mode = "w";
};

/// Writes pages of `width` pixels a row, one strip each.
template <class Sample>
void write_tiff(const std::filesystem::path& file, int width,
                const std::vector<std::vector<Sample>>& pages, const TiffTags& tags = {}) {
  TIFF* tiff = TIFFOpen(file.c_str(), tags.mode);
  ASSERT_TRUE(tiff);
  for (std::size_t k = 0; k < pages.size(); ++k) {
    const int height = static_cast<int>(pages[k].size()) / (width * tags.samples);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(Sample)));
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, tags.samples);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, tags.format);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
                 tags.samples == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, height);
    if (tags.orientation > 0) TIFFSetField(tiff, TIFFTAG_ORIENTATION, tags.orientation);
    if (k == 0 && !tags.description.empty())
      TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, tags.description.c_str());
    if (k == 0 && tags.resolution > 0) {
      TIFFSetField(tiff, TIFFTAG_XRESOLUTION, tags.resolution);
      TIFFSetField(tiff, TIFFTAG_YRESOLUTION, tags.resolution);
    }
    for (int y = 0; y < height; ++y) {
      const auto in_row = static_cast<std::size_t>(width * tags.samples);
      std::vector<Sample> row(pages[k].begin() + static_cast<std::ptrdiff_t>(in_row) * y,
                              pages[k].begin() + static_cast<std::ptrdiff_t>(in_row) * (y + 1));
      TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(y), 0);
    }
    TIFFWriteDirectory(tiff);
  }
  TIFFClose(tiff);
}

}  // namespace microswarm::test
