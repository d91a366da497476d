// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/picture.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/report/drawing_file.hpp"

namespace microswarm::report {
namespace {

constexpr double picture_margin = 24;
constexpr double title_height = 34;
constexpr double foot_height = 52;
constexpr double min_disc_radius = 4;  // smaller discs would be invisible

constexpr double key_line = 22;  // line height of the legend

/// The largest 1, 2 or 5 times a power of ten that is at most `most`.
double round_length(double most) {
  const double power = maths::power(10.0, static_cast<int>(std::floor(maths::log10(most))));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= most) return factor * power;
  return power;
}

}  // namespace

struct Picture::Impl {
  struct LegendEntry {
    std::string label;
    Colour colour;
    bool round;
    double x = 0;     // of the left end
    double down = 0;  // below the first line
  };

  Box view;
  std::string title;
  double scale;
  double width;
  double height;  // with a one-line legend
  double key_end = 0;
  double key_down = 0;  // of the last line below the first
  cairo_surface_t* recording;
  cairo_t* cr;
  std::vector<LegendEntry> entries;
  std::vector<Box> texts;             // positions of the texts [px]
  cairo_surface_t* pixels = nullptr;  // of the drawing, made when another picture needs them

  Impl(const Box& v, std::string_view t, double longer_side)
      : view(v), title(t), scale(longer_side / std::max(v.width(), v.height())) {
    width = v.width() * scale + 2 * picture_margin;
    height = v.height() * scale + picture_margin + top() + foot_height;
    recording = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr);
    cr = cairo_create(recording);
    cairo_rectangle(cr, picture_margin, top(), v.width() * scale, v.height() * scale);
    cairo_clip(cr);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  }
  ~Impl() {
    if (pixels) cairo_surface_destroy(pixels);
    cairo_destroy(cr);
    cairo_surface_destroy(recording);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Position for a text: the wanted one, or the nearest free one a few lines above or below.
  Vec2 place_for_text(Vec2 wanted, double text_width, double size) {
    constexpr int max_lines = 6;
    constexpr double gap = 3;  // [px]
    const double highest = top() + size + 2;
    const double lowest = std::max(highest, top() + view.height() * scale - gap);
    const auto box_at = [&](double y) {
      return Box{{wanted.x - gap, y - size}, {wanted.x + text_width + gap, y + gap}};
    };
    double y = std::clamp(wanted.y, highest, lowest);
    for (int k = 0; k <= 2 * max_lines; ++k) {
      const int lines = k % 2 == 1 ? (k + 1) / 2 : -k / 2;
      const double tried = std::clamp(wanted.y + lines * (size + gap), highest, lowest);
      const Box box = box_at(tried);
      const bool is_free = std::none_of(texts.begin(), texts.end(), [&](const Box& other) {
        return box.lo.x < other.hi.x && other.lo.x < box.hi.x && box.lo.y < other.hi.y &&
               other.lo.y < box.hi.y;
      });
      if (!is_free) continue;
      y = tried;
      break;
    }
    texts.push_back(box_at(y));
    return {wanted.x, y};
  }

  double top() const { return title.empty() ? picture_margin : picture_margin + title_height; }
  Vec2 at(Vec2 p) const {
    return {picture_margin + (p.x - view.lo.x) * scale, top() + (view.hi.y - p.y) * scale};
  }
  void colour(Colour c) const { cairo_set_source_rgba(cr, c.red, c.green, c.blue, c.alpha); }
  void trace(std::span<const Vec2> points) const {
    for (const Vec2 p : points) {
      const Vec2 q = at(p);
      cairo_line_to(cr, q.x, q.y);
    }
  }
  void trace(const Disc& d) const {
    const Vec2 c = at(d.centre);
    cairo_new_sub_path(cr);
    cairo_arc(cr, c.x, c.y, std::max(d.radius * scale, min_disc_radius), 0, 2 * pi);
  }
  void trace(const Polygon& polygon) const {
    trace(polygon.outer);
    cairo_close_path(cr);
    for (const auto& hole : polygon.holes) {
      cairo_new_sub_path(cr);
      trace(hole);
      cairo_close_path(cr);
    }
  }
  void fill(const Body& body, Colour c) const {
    cairo_new_path(cr);
    std::visit([&](const auto& shape) { trace(shape); }, body.shape);
    cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
    colour(c);
    cairo_fill_preserve(cr);
  }
  void stroke(Colour c, double width_px) const {
    colour(c);
    cairo_set_line_width(cr, width_px);
    cairo_stroke(cr);
  }

  Vec2 size() const { return {std::ceil(width), std::ceil(height + key_down)}; }
  void finish(cairo_t* out) const;
  void frame(cairo_t* out) const;
  void scale_bar(cairo_t* out) const;
  void key(cairo_t* out) const;
  void add_to_key(std::string_view label, Colour c, bool round);
};

void Picture::Impl::scale_bar(cairo_t* out) const {
  const double length = round_length(0.25 * view.width());
  const double y = height - foot_height + 22;
  cairo_set_source_rgba(out, colours::ink.red, colours::ink.green, colours::ink.blue, 1);
  cairo_rectangle(out, picture_margin, y - 3, length * scale, 5);
  cairo_fill(out);
  cairo_set_font_size(out, 15);
  cairo_move_to(out, picture_margin, y + 20);
  cairo_show_text(out, fmt::format("{:g} µm", length).c_str());
}

/// Wraps at the picture's width, next to the scale bar.
void Picture::Impl::add_to_key(std::string_view label, Colour c, bool round) {
  const double left =
      picture_margin + std::max(120.0, round_length(0.25 * view.width()) * scale + 40);
  cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, 15);
  cairo_text_extents_t extents;
  const std::string shown = printable(label);
  cairo_text_extents(cr, shown.c_str(), &extents);
  const double length = (round ? 20 : 24) + extents.x_advance;
  if (entries.empty()) key_end = left;
  if (key_end > left && key_end + length > width - picture_margin) {
    key_end = left;
    key_down += key_line;
  }
  entries.push_back({shown, c, round, key_end, key_down});
  key_end += length + 22;
}

void Picture::Impl::key(cairo_t* out) const {
  cairo_set_font_size(out, 15);
  for (const LegendEntry& e : entries) {
    const double y = height - foot_height + 26 + e.down;
    cairo_set_source_rgba(out, e.colour.red, e.colour.green, e.colour.blue, e.colour.alpha);
    if (e.round)
      cairo_arc(out, e.x + 7, y - 5, 7, 0, 2 * pi);
    else
      cairo_rectangle(out, e.x, y - 9, 18, 8);
    cairo_fill(out);
    cairo_set_source_rgba(out, colours::ink.red, colours::ink.green, colours::ink.blue, 1);
    cairo_move_to(out, e.x + (e.round ? 20 : 24), y);
    cairo_show_text(out, e.label.c_str());
  }
}

void Picture::Impl::frame(cairo_t* out) const {
  cairo_select_font_face(out, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_source_rgba(out, colours::ink.red, colours::ink.green, colours::ink.blue, 1);
  cairo_set_line_width(out, 1);
  cairo_rectangle(out, picture_margin, top(), view.width() * scale, view.height() * scale);
  cairo_stroke(out);
  if (!title.empty()) {
    cairo_set_font_size(out, 20);
    cairo_move_to(out, picture_margin, picture_margin + 18);
    cairo_show_text(out, printable(title).c_str());
  }
  scale_bar(out);
  key(out);
}

void Picture::Impl::finish(cairo_t* out) const {
  cairo_set_source_surface(out, recording, 0, 0);
  cairo_paint(out);
  frame(out);
}

Picture::Picture(const Box& view, std::string_view title, double pixels)
    : impl_(std::make_unique<Impl>(view, title, pixels)) {}
Picture::~Picture() = default;

double Picture::um_per_px() const { return 1 / impl_->scale; }

void Picture::photo(const formats::Image& image, double um_per_px, double fade) {
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height);
  unsigned char* data = cairo_image_surface_get_data(surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const std::uint8_t* p = &image.pixels[image.index(column, row)];
      const auto faded = [&](std::uint8_t v) {
        return static_cast<std::uint32_t>(std::lround(v + fade * (255 - v)));
      };
      const std::uint32_t rgb = image.channels == 3
                                    ? faded(p[0]) << 16 | faded(p[1]) << 8 | faded(p[2])
                                    : faded(p[0]) * 0x010101U;
      reinterpret_cast<std::uint32_t*>(data + static_cast<std::size_t>(row) * stride)[column] = rgb;
    }
  cairo_surface_mark_dirty(surface);
  const Vec2 corner = impl_->at({0, image.height * um_per_px});
  cairo_save(impl_->cr);
  cairo_translate(impl_->cr, corner.x, corner.y);
  cairo_scale(impl_->cr, um_per_px * impl_->scale, um_per_px * impl_->scale);
  cairo_set_source_surface(impl_->cr, surface, 0, 0);
  cairo_paint(impl_->cr);
  cairo_restore(impl_->cr);
  cairo_surface_destroy(surface);
}

void Picture::ground(const Picture& other) {
  Impl& from = *other.impl_;
  if (!from.pixels) {
    const Vec2 size = from.size();
    from.pixels = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(size.x),
                                             static_cast<int>(size.y));
    cairo_t* out = cairo_create(from.pixels);
    cairo_set_source_surface(out, from.recording, 0, 0);
    cairo_paint(out);
    cairo_destroy(out);
  }
  cairo_set_source_surface(impl_->cr, from.pixels, 0, 0);
  cairo_paint(impl_->cr);
}

void Picture::walls(const Map& map, Colour fill, Colour edge) {
  for (const Body& body : map.walls().bodies()) {
    impl_->fill(body, fill);
    impl_->stroke(edge, 1);
  }
}

void Picture::bodies(std::span<const Body> bodies, Colour fill) {
  for (const Body& body : bodies) {
    impl_->fill(body, fill);
    impl_->stroke({0.6 * fill.red, 0.6 * fill.green, 0.6 * fill.blue, fill.alpha}, 1);
  }
}

void Picture::tree(std::span<const TreeNode> tree, Colour colour) {
  cairo_new_path(impl_->cr);
  for (const TreeNode& node : tree) {
    const Vec2 from = impl_->at(tree[node.parent].position);
    const Vec2 to = impl_->at(node.position);
    cairo_move_to(impl_->cr, from.x, from.y);
    cairo_line_to(impl_->cr, to.x, to.y);
  }
  impl_->stroke(colour, 1);
}

void Picture::line(std::span<const Vec2> points, Colour colour, double width_px, bool dashed) {
  constexpr double dash[] = {8, 6};
  cairo_new_path(impl_->cr);
  impl_->trace(points);
  if (dashed) cairo_set_dash(impl_->cr, dash, 2, 0);
  impl_->stroke(colour, width_px);
  cairo_set_dash(impl_->cr, nullptr, 0, 0);
}

void Picture::disc(Disc disc, Colour fill) {
  cairo_new_path(impl_->cr);
  impl_->trace(disc);
  impl_->colour(fill);
  cairo_fill(impl_->cr);
}

void Picture::circle(Disc disc, Colour colour, double width_px, bool dashed) {
  constexpr double dash[] = {6, 4};
  cairo_new_path(impl_->cr);
  impl_->trace(disc);
  if (dashed) cairo_set_dash(impl_->cr, dash, 2, 0);
  impl_->stroke(colour, width_px);
  cairo_set_dash(impl_->cr, nullptr, 0, 0);
}

void Picture::swarm(const Pose2& pose, double radius, Colour colour) {
  disc({pose.position, radius}, colour);
  const Vec2 nose = pose.position + radius * unit_vector(pose.heading);
  const Vec2 tick[] = {pose.position, nose};
  line(tick, colours::paper, 2);
}

void Picture::mark(Vec2 at, std::string_view label, Colour colour) {
  const Vec2 p = impl_->at(at);
  cairo_new_path(impl_->cr);
  cairo_arc(impl_->cr, p.x, p.y, 9, 0, 2 * pi);
  impl_->stroke(colours::paper, 6);
  cairo_arc(impl_->cr, p.x, p.y, 9, 0, 2 * pi);
  impl_->stroke(colour, 3);
  const double up = 14 / impl_->scale;
  text(at + Vec2{up, up}, label, colour, 17);
}

void Picture::text(Vec2 at, std::string_view text, Colour colour, double size_px) {
  const Vec2 p = impl_->at(at);
  cairo_t* cr = impl_->cr;
  cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size_px);
  cairo_text_extents_t extents;
  const std::string shown = printable(text);
  cairo_text_extents(cr, shown.c_str(), &extents);
  const double right = picture_margin + impl_->view.width() * impl_->scale - extents.x_advance - 6;
  const Vec2 position =
      impl_->place_for_text({std::min(p.x, right), p.y}, extents.x_advance, size_px);
  cairo_move_to(cr, position.x, position.y);
  cairo_text_path(cr, shown.c_str());
  impl_->colour({1, 1, 1, 0.85});
  cairo_set_line_width(cr, 4);
  cairo_stroke_preserve(cr);
  impl_->colour(colour);
  cairo_fill(cr);
}

void Picture::legend(std::string_view label, Colour colour, bool round) {
  impl_->add_to_key(label, colour, round);
}

formats::Image Picture::raster() const {
  const Vec2 size = impl_->size();
  const auto even = [](double side) { return (static_cast<int>(side) + 1) / 2 * 2; };
  formats::Image image{even(size.x), even(size.y), 3, {}};
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height);
  draw_on_white(surface, [&](cairo_t* out) { impl_->finish(out); });
  cairo_surface_flush(surface);
  image.pixels.reserve(image.index(0, image.height));
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
  for (int row = 0; row < image.height; ++row) {
    const auto* line =
        reinterpret_cast<const std::uint32_t*>(data + static_cast<std::size_t>(row) * stride);
    for (int column = 0; column < image.width; ++column)
      for (const int shift : {16, 8, 0})
        image.pixels.push_back(static_cast<std::uint8_t>(line[column] >> shift));
  }
  cairo_surface_destroy(surface);
  return image;
}

std::string Picture::png() const {
  return drawing_bytes(".png", impl_->size(), [&](cairo_t* out) { impl_->finish(out); });
}

void Picture::write(const std::filesystem::path& path) const {
  write_drawing(path, impl_->size(), [&](cairo_t* out) { impl_->finish(out); });
}

void write_sheet(std::span<const std::unique_ptr<Picture>> pictures, int columns,
                 const std::filesystem::path& path) {
  if (pictures.empty()) return;
  Vec2 cell;
  for (const auto& picture : pictures) {
    const Vec2 size = picture->impl_->size();
    cell = {std::max(cell.x, size.x), std::max(cell.y, size.y)};
  }
  const auto across = std::min(pictures.size(), static_cast<std::size_t>(std::max(1, columns)));
  const std::size_t down = (pictures.size() + across - 1) / across;
  const Vec2 size{cell.x * static_cast<double>(across), cell.y * static_cast<double>(down)};
  write_drawing(path, size, [&](cairo_t* out) {
    for (std::size_t k = 0; k < pictures.size(); ++k) {
      const std::size_t row = k / across, column = k % across;
      cairo_save(out);
      cairo_translate(out, cell.x * static_cast<double>(column), cell.y * static_cast<double>(row));
      pictures[k]->impl_->finish(out);
      cairo_restore(out);
    }
  });
}

void Picture::write_everywhere(const std::filesystem::path& stem) const {
  for (const char* kind : {".png", ".svg", ".pdf"}) write(stem.string() + kind);
}

}  // namespace microswarm::report
