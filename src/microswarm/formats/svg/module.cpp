// SPDX-License-Identifier: Apache-2.0
// libmicroswarm_svg.so, the only part that is linked with librsvg.
#include <librsvg/rsvg.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "microswarm/formats/svg/renderer.hpp"

namespace microswarm::formats {
namespace {

template <class T, void (*release)(T*)>
struct Release {
  void operator()(T* object) const { release(object); }
};
using Surface = std::unique_ptr<cairo_surface_t, Release<cairo_surface_t, cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Release<cairo_t, cairo_destroy>>;
struct Unref {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
};
using Handle = std::unique_ptr<RsvgHandle, Unref>;

std::string text_of(GError* error) {
  std::string text = error ? error->message : "unknown error";
  g_clear_error(&error);
  return text;
}

Handle open(std::string_view svg, std::string& why_not) {
  GError* error = nullptr;
  Handle handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  if (!handle) why_not = text_of(error);
  return handle;
}

constexpr double um_per_inch = 25'400;

/// µm of a length; nothing for one in px, % or em.
std::optional<double> physical_um(const RsvgLength& length) {
  switch (length.unit) {
    case RSVG_UNIT_CM:
      return 1e4 * length.length;
    case RSVG_UNIT_MM:
      return 1e3 * length.length;
    case RSVG_UNIT_IN:
      return um_per_inch * length.length;
    case RSVG_UNIT_PT:
      return um_per_inch / 72 * length.length;
    case RSVG_UNIT_PC:
      return um_per_inch / 6 * length.length;
    default:
      return std::nullopt;
  }
}

/// Whether a side is not given, which librsvg returns as the whole of its surroundings.
bool is_open(const RsvgLength& length) {
  return length.unit == RSVG_UNIT_PERCENT && length.length == 1;
}

class RsvgRenderer : public SvgRenderer {
 public:
  SvgSize measure(std::string_view svg) const override {
    SvgSize size;
    const Handle handle = open(svg, size.error);
    if (!handle) return size;
    gboolean has_width = FALSE, has_height = FALSE, has_box = FALSE;
    RsvgLength width{}, height{};
    RsvgRectangle box{};
    rsvg_handle_get_intrinsic_dimensions(handle.get(), &has_width, &width, &has_height, &height,
                                         &has_box, &box);
    if (has_width && has_height) {
      size.width_um = physical_um(width);
      size.height_um = physical_um(height);
    }
    // A side that is not given follows from the other one, as in a viewer.
    const bool has_shape = has_box && box.width > 0 && box.height > 0;
    if (has_shape && size.width_um && is_open(height))
      size.height_um = *size.width_um * box.height / box.width;
    else if (has_shape && size.height_um && is_open(width))
      size.width_um = *size.height_um * box.width / box.height;
    if (has_box) {
      size.width = box.width, size.height = box.height;
    } else {
      gdouble width_px = 0, height_px = 0;
      rsvg_handle_set_dpi(handle.get(), 96);
      if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width_px, &height_px))
        size.error = "it has neither a width and a height nor a viewBox";
      size.width = width_px, size.height = height_px;
    }
    return size;
  }

  SvgPixels draw(std::string_view svg, double width, double height, int columns,
                 int rows) const override {
    SvgPixels out;
    const Handle handle = open(svg, out.error);
    if (!handle) return out;
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows));
    const Context context(cairo_create(surface.get()));
    cairo_set_source_rgb(context.get(), 1, 1, 1);
    cairo_paint(context.get());
    const RsvgRectangle viewport{0, 0, width, height};
    GError* error = nullptr;
    if (!rsvg_handle_render_document(handle.get(), context.get(), &viewport, &error))
      out.error = text_of(error);
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
      out.error = cairo_status_to_string(cairo_surface_status(surface.get()));
    if (!out.error.empty()) return out;
    cairo_surface_flush(surface.get());
    const unsigned char* row = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    out.grey.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int y = 0; y < rows; ++y, row += stride)
      for (int x = 0; x < columns; ++x) {
        const auto pixel = reinterpret_cast<const std::uint32_t*>(row)[x];
        const unsigned red = pixel >> 16 & 255, green = pixel >> 8 & 255, blue = pixel & 255;
        out.grey.push_back(
            static_cast<std::uint8_t>((299 * red + 587 * green + 114 * blue + 500) / 1000));
      }
    return out;
  }
};

}  // namespace
}  // namespace microswarm::formats

/// Symbol that svg_renderer() looks up.
extern "C" const microswarm::formats::SvgRenderer* microswarm_svg() {
  static const microswarm::formats::RsvgRenderer only;
  return &only;
}
