// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm::report {

/// A function that draws on a page.
using DrawOn = std::function<void(cairo_t*)>;

/// Draws on a white surface.
void draw_on_white(cairo_surface_t* surface, const DrawOn& draw);

/// Draws on a white page of `size` pixels and returns the bytes of a file. `kind` is ".png", ".svg"
/// or ".pdf"; for another kind the result is empty.
std::string drawing_bytes(std::string_view kind, Vec2 size, const DrawOn& draw);

/// The same into a file; its extension is the kind. Throws InputError for another kind, and if the
/// file cannot be written.
void write_drawing(const std::filesystem::path& path, Vec2 size, const DrawOn& draw);

}  // namespace microswarm::report
