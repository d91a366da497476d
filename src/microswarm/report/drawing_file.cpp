// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/drawing_file.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"

namespace microswarm::report {
namespace {

cairo_status_t append(void* out, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

void draw_on_white(cairo_surface_t* surface, const DrawOn& draw) {
  cairo_t* out = cairo_create(surface);
  cairo_set_source_rgba(out, 1, 1, 1, 1);
  cairo_paint(out);
  draw(out);
  cairo_destroy(out);
}

std::string drawing_bytes(std::string_view kind, Vec2 size, const DrawOn& draw) {
  std::string bytes;
  cairo_surface_t* surface = nullptr;
  if (kind == ".png")
    surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(size.x),
                                         static_cast<int>(size.y));
  else if (kind == ".svg")
    surface = cairo_svg_surface_create_for_stream(append, &bytes, size.x, size.y);
  else if (kind == ".pdf")
    surface = cairo_pdf_surface_create_for_stream(append, &bytes, size.x, size.y);
  else
    return bytes;
  draw_on_white(surface, draw);
  if (kind == ".png") cairo_surface_write_to_png_stream(surface, append, &bytes);
  cairo_surface_finish(surface);
  cairo_surface_destroy(surface);
  return bytes;
}

void write_drawing(const std::filesystem::path& path, Vec2 size, const DrawOn& draw) {
  const std::string bytes = drawing_bytes(path.extension().string(), size, draw);
  if (bytes.empty()) throw InputError(path.string(), "a picture is .png, .svg or .pdf");
  write_file_atomically(path, bytes);
}

}  // namespace microswarm::report
