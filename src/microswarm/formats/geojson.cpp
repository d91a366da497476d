// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/geojson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/json_place.hpp"
#include "microswarm/formats/ring_fault.hpp"
#include "microswarm/formats/thick_line.hpp"
#include "microswarm/world/obstacles/clip.hpp"

namespace microswarm::formats {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t max_geojson_bytes = 64ULL << 20;
constexpr int max_depth = 32;
constexpr std::string_view read_kinds =
    "Polygon, MultiPolygon, LineString or MultiLineString with a width, and Point or MultiPoint "
    "with a radius are read";

/// The library's message without its prefix "[json.exception.…] ".
std::string complaint(const Json::exception& error) {
  const std::string_view what = error.what();
  const std::size_t end = what.find("] ");
  return one_line(end == std::string_view::npos ? what : what.substr(end + 2));
}

Json parse(std::string_view text, std::string_view name) {
  const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > max_depth)
      throw InputError(std::string(name), "nested deeper than " + std::to_string(max_depth));
    return true;
  };
  try {
    return Json::parse(text, shallow);
  } catch (const Json::parse_error& error) {
    const std::string_view before = text.substr(0, std::min(error.byte, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    throw InputError(std::string(name), static_cast<int>(line), 0, "not JSON: " + complaint(error));
  } catch (const Json::exception& error) {
    throw InputError(std::string(name), "not JSON: " + complaint(error));
  }
}

std::string point_text(Vec2 p) { return fmt::format("({:.6g}, {:.6g}) µm", p.x, p.y); }

/// Traverses the document and collects walls and discs.
class GeoJsonReader {
 public:
  GeoJsonReader(std::string_view text, std::string_view name, std::optional<double> um_per_unit,
                double line_width)
      : text_(text), name_(name), unit_is_given_(um_per_unit), line_width_(line_width) {
    um_per_unit_ = um_per_unit.value_or(1);
  }

  MapParts read(const Json& root) {
    const JsonPlace document;
    read_unit(root, document);
    object(root, document, {nullptr, nullptr});
    if (!bounds_) bounds_ = bbox(root, document);
    parts_.bounds = bounds_.value_or(enclosing_box(parts_));
    if (!bounds_ && parts_.walls.empty() && parts_.discs.empty())
      fail(document, "no walls, no discs and no bounds");
    if (crossing_rings_ > 1)
      parts_.notes.push_back(
          fmt::format("{}: {} rings in all cross themselves", name_, crossing_rings_));
    if (!unit_is_given_) note_unit();
    return std::move(parts_);
  }

 private:
  /// Properties of the feature that contains a geometry; null outside features.
  struct Properties {
    const Json* value;
    const JsonPlace* place;
  };

  /// The unit that files of geojson_text give.
  void read_unit(const Json& root, const JsonPlace& document) {
    if (unit_is_given_ || !root.is_object() || !root.contains("um_per_unit")) return;
    const JsonPlace place = document.member("um_per_unit");
    const double unit = number(root["um_per_unit"], place);
    if (!(unit > 0)) fail(place, number_text(unit) + ", must be above 0");
    um_per_unit_ = unit;
    unit_is_given_ = true;
  }

  /// Refuses coordinates of the Earth unless their unit was given.
  void check_crs(const Json& value, const JsonPlace& place) const {
    const auto found = value.find("crs");
    if (unit_is_given_ || found == value.end() || found->is_null()) return;
    const Json::json_pointer path("/properties/name");
    const bool has_name = found->is_object() && found->contains(path) && (*found)[path].is_string();
    const std::string crs =
        has_name ? quote((*found)[path].get<std::string>()) + " is given" : "is given";
    fail(place.member("crs"), crs + ": coordinates may be degrees or metres; give " +
                                  input_name("um_per_unit") + ", the µm for a unit of the file");
  }

  /// Notes coordinates that are probably no µm.
  void note_unit() {
    Box all = enclosing_box(parts_);
    all.include(parts_.bounds.lo);
    all.include(parts_.bounds.hi);
    const std::string advice = "they are read as µm; if they are not, give " +
                               input_name("um_per_unit") + ", the µm for a unit";
    constexpr double max_longitude = 180, max_latitude = 90, far = 100;
    if (std::max(std::abs(all.lo.x), std::abs(all.hi.x)) <= max_longitude &&
        std::max(std::abs(all.lo.y), std::abs(all.hi.y)) <= max_latitude)
      parts_.notes.push_back(fmt::format(
          "{}: all coordinates are within ±180 and ±90, as degrees are: {}", name_, advice));
    else if (norm(all.centre()) > far * std::max(all.width(), all.height()))
      parts_.notes.push_back(
          fmt::format("{}: the map of {:.4g} × {:.4g} is far from the origin, as one in metres of "
                      "a country is: {}",
                      name_, all.width(), all.height(), advice));
  }

  std::string located(const JsonPlace& place, const std::string& why) const {
    const std::string where = place.text();
    return fmt::format("{}:{}: {}{}", name_, line_number(text_, place),
                       where.empty() ? "" : where + ": ", why);
  }

  [[noreturn]] void fail(const JsonPlace& place, const std::string& why) const {
    const std::string where = place.text();
    throw InputError(name_, line_number(text_, place), 0, where.empty() ? why : where + ": " + why);
  }

  const Json& member(const Json& parent, const JsonPlace& place, const char* key) const {
    const auto found = parent.find(key);
    if (found == parent.end()) fail(place, "'" + std::string(key) + "' is missing");
    return *found;
  }

  const Json& array(const Json& value, const JsonPlace& place) const {
    if (!value.is_array()) fail(place, "an array expected, not " + std::string(value.type_name()));
    return value;
  }

  /// Calls visit(entry, its position) for each entry of the array `key`.
  template <class Visit>
  void each(const Json& parent, const JsonPlace& place, const char* key, Visit&& visit) const {
    const JsonPlace here = place.member(key);
    each_entry(member(parent, place, key), here, visit);
  }
  template <class Visit>
  void each_entry(const Json& list, const JsonPlace& place, Visit&& visit) const {
    for (std::size_t i = 0; i < array(list, place).size(); ++i) visit(list[i], place.entry(i));
  }

  /// Reads a collection, a feature or a geometry.
  void object(const Json& value, const JsonPlace& place, const Properties& properties) {
    if (!value.is_object())
      fail(place, "an object expected, not " + std::string(value.type_name()));
    if (!value.contains("type") && value.contains("geometryType"))
      fail(place, "Esri's JSON is not read: export GeoJSON");
    const Json& type = member(value, place, "type");
    if (!type.is_string()) fail(place.member("type"), "a word expected");
    const auto& word = type.get_ref<const std::string&>();
    check_crs(value, place);
    const auto inner = [&](const Json& v, const JsonPlace& p) { object(v, p, properties); };
    if (word == "FeatureCollection")
      each(value, place, "features", inner);
    else if (word == "Feature")
      feature(value, place);
    else if (word == "GeometryCollection")
      each(value, place, "geometries", inner);
    else
      geometry(word, value, place, properties);
  }

  void feature(const Json& value, const JsonPlace& place) {
    const Json& shape = member(value, place, "geometry");
    const JsonPlace shape_place = place.member("geometry");
    if (shape.is_null()) return;
    const JsonPlace properties_place = place.member("properties");
    const auto found = value.find("properties");
    const Json* properties = found != value.end() && found->is_object() ? &found.value() : nullptr;
    if (is_bounds(properties, properties_place)) {
      if (bounds_) fail(place, "a second feature with the property 'bounds': only one is the map");
      bounds_ = rectangle(shape, shape_place);
    } else {
      object(shape, shape_place, {properties, &properties_place});
    }
  }

  /// Whether a feature is the extent of the map.
  bool is_bounds(const Json* properties, const JsonPlace& place) const {
    if (!properties) return false;
    const auto found = properties->find("bounds");
    if (found == properties->end() || found->is_null()) return false;
    if (!found->is_boolean())
      fail(place.member("bounds"),
           "true or false expected, not a " + std::string(found->type_name()));
    return found->get<bool>();
  }

  void geometry(const std::string& type, const Json& value, const JsonPlace& place,
                const Properties& properties) {
    if (type == "Topology")
      fail(place.member("type"),
           "TopoJSON is not read: convert it to GeoJSON, e.g. with ogr2ogr or topo2geo");
    if (type == "CityJSON") fail(place.member("type"), "CityJSON is not read: export GeoJSON");
    const JsonPlace here = place.member("coordinates");
    const auto wall = [&](const Json& v, const JsonPlace& p) { add_wall(polygon(v, p), p); };
    const auto line = [&](const Json& v, const JsonPlace& p) {
      add_line(v, p, line_width(type, properties, place));
    };
    const auto disc = [&](const Json& v, const JsonPlace& p) {
      parts_.discs.push_back({position(v, p), radius(properties, place)});
    };
    constexpr std::string_view known[] = {"Polygon",         "MultiPolygon", "LineString",
                                          "MultiLineString", "Point",        "MultiPoint"};
    if (std::ranges::find(known, type) == std::end(known))
      fail(place.member("type"), fmt::format("{} is no wall: {}", quote(type), read_kinds));
    const Json& coordinates = member(value, place, "coordinates");
    if (type == "Polygon")
      wall(coordinates, here);
    else if (type == "MultiPolygon")
      each_entry(coordinates, here, wall);
    else if (type == "LineString")
      line(coordinates, here);
    else if (type == "MultiLineString")
      each_entry(coordinates, here, line);
    else if (type == "Point")
      disc(coordinates, here);
    else
      each_entry(coordinates, here, disc);
  }

  /// Refuses rings that leave unclear what is a wall. A ring without holes that crosses itself is
  /// noted, and what it goes round is a wall.
  void add_wall(Polygon wall, const JsonPlace& place) {
    const auto within = [&](auto&& judge) {
      try {
        return judge();
      } catch (const InputError& error) {
        fail(place, error.what());
      }
    };
    const std::optional<RingFault> fault = within([&] { return find_ring_fault(wall); });
    if (!fault) {
      parts_.walls.push_back(std::move(wall));
      return;
    }
    using Kind = RingFault::Kind;
    const JsonPlace first = place.entry(fault->first), second = place.entry(fault->second);
    const std::string at = " at " + point_text(fault->at);
    if (fault->kind == Kind::hole_outside)
      fail(first, "the hole is outside its ring, or in another hole," + at);
    if (fault->kind == Kind::rings_cross)
      fail(second, (fault->first == 0 ? "the hole crosses its ring" : "two holes cross") + at);
    if (!wall.holes.empty()) fail(first, "the ring crosses itself" + at);
    if (++crossing_rings_ == 1)
      parts_.notes.push_back(
          located(first, "the ring crosses itself" + at + "; all that it goes round is a wall"));
    for (Polygon& part : within([&] { return united(std::span(&wall, 1)); }))
      parts_.walls.push_back(std::move(part));
  }

  /// Width of a line [µm], of its feature or for all lines.
  double line_width(const std::string& type, const Properties& properties,
                    const JsonPlace& line) const {
    if (!properties.value || !properties.value->contains("width")) {
      if (line_width_ > 0) return line_width_;
      fail(line.member("type"),
           fmt::format("{} is no wall without a width: give its feature the property 'width', or "
                       "give line_width_um; {}",
                       quote(type), read_kinds));
    }
    const JsonPlace place = properties.place->member("width");
    const double width = number((*properties.value)["width"], place);
    if (!(width >= min_line_width))
      fail(place,
           fmt::format("{} µm, at least {}", number_text(width), number_text(min_line_width)));
    return width;
  }

  void add_line(const Json& positions, const JsonPlace& place, double width) {
    std::vector<Vec2> points;
    each_entry(positions, place,
               [&](const Json& v, const JsonPlace& p) { points.push_back(position(v, p)); });
    if (points.size() < 2)
      fail(place, fmt::format("a line of {} positions, at least 2", points.size()));
    add_thick_line(parts_, points, width);
  }

  double number(const Json& value, const JsonPlace& place) const {
    if (!value.is_number()) fail(place, "a number expected, not " + std::string(value.type_name()));
    const double um = value.get<double>() * um_per_unit_;
    if (!(std::abs(um) <= max_coordinate))
      fail(place, number_text(um) + " µm, at most " + number_text(max_coordinate));
    return um;
  }

  Vec2 position(const Json& value, const JsonPlace& place) const {
    if (array(value, place).size() < 2)
      fail(place, "a position of " + std::to_string(value.size()) + " numbers, at least 2");
    return {number(value[0], place.entry(0)), number(value[1], place.entry(1))};
  }

  double radius(const Properties& properties, const JsonPlace& point) const {
    if (!properties.value || !properties.value->contains("radius"))
      fail(point, "a point needs the property 'radius' of its feature to be a disc");
    const JsonPlace place = properties.place->member("radius");
    const double r = number((*properties.value)["radius"], place);
    if (!(r > 0)) fail(place, number_text(r) + " µm, must be above 0");
    return r;
  }

  Polygon polygon(const Json& rings, const JsonPlace& place) const {
    Polygon polygon;
    each_entry(rings, place, [&](const Json& v, const JsonPlace& p) {
      if (p.index == 0)
        polygon.outer = ring(v, p);
      else
        polygon.holes.push_back(ring(v, p));
    });
    if (polygon.outer.empty()) fail(place, "a polygon without a ring");
    return normalised(std::move(polygon));
  }

  std::vector<Vec2> ring(const Json& positions, const JsonPlace& place) const {
    std::vector<Vec2> points;
    each_entry(positions, place,
               [&](const Json& v, const JsonPlace& p) { points.push_back(position(v, p)); });
    if (points.size() < 4)
      fail(place, "a ring of " + std::to_string(points.size()) +
                      " positions, at least 4 (the last repeats the first)");
    if (points.front() != points.back()) fail(place, "a ring that does not end where it begins");
    if (signed_area(points) == 0 && !find_ring_fault(normalised({points, {}})))
      fail(place, "a ring without area");
    return points;
  }

  Box rectangle(const Json& value, const JsonPlace& place) const {
    if (!value.is_object() || value.value("type", Json()) != "Polygon")
      fail(place, "the bounds must be a Polygon");
    const Polygon shape = polygon(member(value, place, "coordinates"), place.member("coordinates"));
    const Box box = bounding_box(shape);
    const bool right_angles = std::all_of(shape.outer.begin(), shape.outer.end(), [&](Vec2 p) {
      return (p.x == box.lo.x || p.x == box.hi.x) && (p.y == box.lo.y || p.y == box.hi.y);
    });
    if (shape.outer.size() != 4 || !shape.holes.empty() || !right_angles)
      fail(place, "the bounds must be a rectangle along the axes");
    return box;
  }

  std::optional<Box> bbox(const Json& root, const JsonPlace& document) const {
    if (!root.contains("bbox")) return std::nullopt;
    std::vector<double> sides;
    each(root, document, "bbox",
         [&](const Json& v, const JsonPlace& p) { sides.push_back(number(v, p)); });
    const std::size_t half = sides.size() / 2;
    if (sides.size() != 4 && sides.size() != 6)
      fail(document.member("bbox"), std::to_string(sides.size()) + " numbers, 4 or 6 expected");
    return Box{{sides[0], sides[1]}, {sides[half], sides[half + 1]}};
  }

  std::string_view text_;
  std::string name_;
  double um_per_unit_ = 1;
  bool unit_is_given_;
  double line_width_;
  int crossing_rings_ = 0;
  MapParts parts_;
  std::optional<Box> bounds_;
};

std::string position_text(Vec2 p) {
  return fmt::format("[{},{}]", number_text(p.x), number_text(p.y));
}

std::string ring_text(const std::vector<Vec2>& ring) {
  std::string text = "[";
  for (const Vec2 p : ring) text += position_text(p) + ",";
  return text + position_text(ring.front()) + "]";
}

std::string polygon_text(const Polygon& polygon) {
  std::string rings = ring_text(polygon.outer);
  for (const auto& hole : polygon.holes) rings.append(",").append(ring_text(hole));
  return fmt::format(R"({{"type":"Polygon","coordinates":[{}]}})", rings);
}

std::string feature_text(std::string_view properties, std::string_view geometry) {
  return fmt::format(R"({{"type":"Feature","properties":{{{}}},"geometry":{}}})", properties,
                     geometry);
}

std::string disc_text(const Disc& disc) {
  return feature_text(
      fmt::format(R"("radius":{})", number_text(disc.radius)),
      fmt::format(R"({{"type":"Point","coordinates":{}}})", position_text(disc.centre)));
}

}  // namespace

MapParts parse_geojson(std::string_view text, std::string_view name,
                       std::optional<double> um_per_unit, double line_width) {
  const Json root = parse(text, name);
  return GeoJsonReader(text, name, um_per_unit, line_width).read(root);
}

MapParts read_geojson(const std::filesystem::path& path, std::optional<double> um_per_unit,
                      double line_width) {
  return parse_geojson(read_file(path, max_geojson_bytes), path.string(), um_per_unit, line_width);
}

std::string geojson_text(const MapParts& parts) {
  const auto [lo, hi] = parts.bounds;
  const Polygon frame{{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, {}};
  std::string text = "{\"type\":\"FeatureCollection\",\"um_per_unit\":1,\"features\":[\n";
  text += feature_text(R"("bounds":true)", polygon_text(frame));
  for (const Polygon& wall : parts.walls) text += ",\n" + feature_text("", polygon_text(wall));
  for (const Disc& disc : parts.discs) text += ",\n" + disc_text(disc);
  return text + "\n]}\n";
}

}  // namespace microswarm::formats
