// SPDX-License-Identifier: Apache-2.0
// Maps, and paths in them.
#include "handles.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/pixel_map.hpp"

using namespace microswarm;

namespace {

void add_lines(std::string& text, const Notes& lines) {
  for (const std::string& line : lines) text += (text.empty() ? line : "\n" + line);
}

std::unique_ptr<c::Object> of(std::shared_ptr<const Map> map, std::string name) {
  auto object = std::make_unique<c::Object>();
  object->map = std::make_unique<c::OpenMap>(c::OpenMap{Snapshot(std::move(map)), std::move(name)});
  return object;
}

}  // namespace

int32_t ms_map_open(const char* file, double um_per_px, uint64_t* map) {
  return ms_map_open_with(file, um_per_px, nullptr, 0, map);
}

int32_t ms_map_open_with(const char* file, double um_per_px, const char* const* settings,
                         size_t count, uint64_t* map) {
  return c::guarded([&]() -> int32_t {
    c::require(file, "file"), c::require(map, "map");
    const auto scale = um_per_px != 0 ? std::optional(um_per_px) : std::nullopt;
    const formats::LoadedMap loaded = formats::load_map(formats::choose_map_spec(
        file, {.um_per_px = scale, .settings = c::to_settings(settings, count)}));
    auto object = of(loaded.map, file);
    add_lines(object->map->notes_of_reading, loaded.notes);
    object->map->notes = object->map->notes_of_reading;
    *map = c::keep(std::move(object));
    return MS_OK;
  });
}

int32_t ms_map_notes(uint64_t handle, const char** notes) {
  return c::with_map(handle, [&](c::OpenMap& map, c::Object&) -> int32_t {
    c::require(notes, "notes");
    *notes = map.notes.c_str();
    return MS_OK;
  });
}

int32_t ms_map_from_pixels(const uint8_t* pixels, size_t width, size_t height, double um_per_px,
                           uint64_t* map) {
  return ms_map_from_pixels_with(pixels, width, height, um_per_px, nullptr, 0, map);
}

int32_t ms_map_from_pixels_with(const uint8_t* pixels, size_t width, size_t height,
                                double um_per_px, const char* const* settings, size_t count,
                                uint64_t* map) {
  return c::guarded([&]() -> int32_t {
    c::require(pixels, "pixels"), c::require(map, "map");
    formats::PixelMapKey key;
    set_values(key, c::to_settings(settings, count));
    formats::PixelMap made =
        formats::map_of_pixels({pixels, width * height}, width, height, um_per_px, key.map);
    auto object = of(std::make_shared<const Map>(std::move(made.map)), "map");
    add_lines(object->map->notes_of_reading, made.notes);
    object->map->notes = object->map->notes_of_reading;
    *map = c::keep(std::move(object));
    return MS_OK;
  });
}

int32_t ms_map_bounds(uint64_t handle, double* x_lo, double* y_lo, double* x_hi, double* y_hi) {
  return c::with_map(handle, [&](c::OpenMap& map, c::Object&) -> int32_t {
    c::require(x_lo, "x_lo"), c::require(y_lo, "y_lo");
    c::require(x_hi, "x_hi"), c::require(y_hi, "y_hi");
    const Box& box = map.world.bounds();
    *x_lo = box.lo.x, *y_lo = box.lo.y, *x_hi = box.hi.x, *y_hi = box.hi.y;
    return MS_OK;
  });
}

int32_t ms_map_clearance(uint64_t handle, double x_um, double y_um, double* clearance_um) {
  return c::with_map(handle, [&](c::OpenMap& map, c::Object&) -> int32_t {
    c::require(clearance_um, "clearance_um");
    const Vec2 position{x_um, y_um};
    if (!is_finite(position)) throw InputError("the place is not finite");
    *clearance_um = map.world.clearance(position);
    return MS_OK;
  });
}

int32_t ms_plan(uint64_t handle, const ms_query* query, ms_path* path) {
  return c::with_map(handle, [&](c::OpenMap& map, c::Object& object) -> int32_t {
    c::require(query, "query"), c::require(path, "path");
    const experiment::PathAnswer made = experiment::answer(
        map.world,
        {.start = {{query->start_x_um, query->start_y_um}, query->start_heading_rad},
         .goal = {query->goal_x_um, query->goal_y_um},
         .settings = c::to_settings(query->settings, query->setting_count),
         .seed = query->seed},
        map.name, Stop(&object.stops));
    object.why = made.why_none();
    map.notes = map.notes_of_reading;
    add_lines(map.notes, made.notes);
    *path = {.solved = made.plan.status == Status::solved,
             .length_um = path_length(made.plan),
             .turning_rad = path_turning(made.plan.path, query->start_heading_rad),
             .time_s = made.seconds,
             .points_um = nullptr,
             .point_count = 0,
             .why_none = object.why.c_str()};
    c::show(object, made.plan.path, &path->points_um, &path->point_count);
    const bool stopped = made.plan.status == Status::stopped;
    object.stops = false;
    return stopped ? c::fail(MS_STOPPED, "the search was stopped") : MS_OK;
  });
}
