// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/jpeg.hpp"

#include <turbojpeg.h>

#include <memory>
#include <string>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::formats {

void decode_jpeg_frame(std::span<const std::byte> bytes, std::string_view name, Image& image) {
  const std::unique_ptr<void, int (*)(tjhandle)> jpeg(tjInitDecompress(), tjDestroy);
  const auto why = [&] { return std::string_view(tjGetErrorStr2(jpeg.get())); };
  const auto fail = [&](std::string_view reason) {
    throw InputError(std::string(name), "damaged JPEG: " + std::string(reason));
  };
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(jpeg.get(), data, bytes.size(), &width, &height, &subsampling,
                          &colours) != 0)
    fail(why());
  if (width == 0 && height == 0) fail("no header of the picture");
  check_image_size(width, height, name);
  if (colours == TJCS_CMYK || colours == TJCS_YCCK) fail("four colours");
  image.width = width;
  image.height = height;
  image.channels = colours == TJCS_GRAY ? 1 : 3;
  image.pixels.resize(image.index(0, height));
  if (tjDecompress2(jpeg.get(), data, bytes.size(), image.pixels.data(), 0, 0, height,
                    image.channels == 1 ? TJPF_GRAY : TJPF_RGB,
                    TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS) != 0) {
    // This warning is raised after the last row.
    if (why().find("extraneous bytes before marker 0xd9") == std::string_view::npos) fail(why());
  }
}

std::string encode_jpeg(const Image& image, int quality) {
  const std::unique_ptr<void, int (*)(tjhandle)> jpeg(tjInitCompress(), tjDestroy);
  const bool grey = image.channels == 1;
  const int sampling = grey ? TJSAMP_GRAY : TJSAMP_420;
  std::string bytes(tjBufSize(image.width, image.height, sampling), '\0');
  auto* data = reinterpret_cast<unsigned char*>(bytes.data());
  unsigned long size = bytes.size();
  if (tjCompress2(jpeg.get(), image.pixels.data(), image.width, 0, image.height,
                  grey ? TJPF_GRAY : TJPF_RGB, &data, &size, sampling, quality,
                  TJFLAG_NOREALLOC) != 0)
    throw InputError(std::string("JPEG: ") + tjGetErrorStr2(jpeg.get()));
  bytes.resize(size);
  return bytes;
}

}  // namespace microswarm::formats
