// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/trackmate_xml.hpp"

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/core/text/unit_names.hpp"
#include "microswarm/vision/tracking/table_field.hpp"

namespace microswarm::vision {
namespace {

constexpr double max_spot_id = 2147483647;
constexpr double max_picture_height = 1e6;

/// A document whose faults are reported with their lines.
class XmlSource {
 public:
  XmlSource(std::string_view text, std::string_view name) : text_(text), name_(name) {
    const pugi::xml_parse_result parsed = document_.load_buffer(text.data(), text.size());
    if (!parsed) fail(parsed.offset, std::string("XML: ") + parsed.description());
  }

  const pugi::xml_document& document() const { return document_; }

  [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& why) const {
    const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text_));
    const auto line = 1 + std::count(text_.begin(), end, '\n');
    throw InputError(std::string(name_), static_cast<int>(line), 0, why);
  }
  auto fail_at(const pugi::xml_node& node) const {
    return [this, node](const std::string& why) { fail(node.offset_debug(), why); };
  }
  double number(const pugi::xml_node& node, const char* key, double least, double most) const {
    return field_number(value(node, key), key, least, most, fail_at(node));
  }
  int whole(const pugi::xml_node& node, const char* key, double most) const {
    return field_whole(value(node, key), key, most, fail_at(node));
  }

 private:
  std::string_view value(const pugi::xml_node& node, const char* key) const {
    const pugi::xml_attribute attribute = node.attribute(key);
    if (!attribute) fail(node.offset_debug(), std::string(key) + " is missing");
    return attribute.value();
  }

  std::string_view text_;
  std::string_view name_;
  pugi::xml_document document_;
};

Vec2 position(const XmlSource& xml, const pugi::xml_node& node, const char* x, const char* y) {
  return {xml.number(node, x, -max_table_position, max_table_position),
          xml.number(node, y, -max_table_position, max_table_position)};
}

/// Time between frames, 1e-6 to 1e6 s, if `value` is one in a known unit.
std::optional<double> to_interval(const pugi::xml_attribute& value,
                                  const pugi::xml_attribute& unit) {
  const std::optional<double> number = parse_number(value.value());
  const std::optional<double> seconds = time_unit_s(unit.value());
  if (!number || !seconds || !(*number * *seconds >= 1e-6 && *number * *seconds <= 1e6))
    return std::nullopt;
  return *number * *seconds;
}

/// Track of each spot.
std::map<int, int> spot_tracks(const XmlSource& xml, const pugi::xml_node& model) {
  std::map<int, bool> passed;
  for (const pugi::xml_node& one : model.child("FilteredTracks").children("TrackID"))
    passed[xml.whole(one, "TRACK_ID", max_table_id)] = true;
  std::map<int, int> tracks;
  for (const pugi::xml_node& track : model.child("AllTracks").children("Track")) {
    const int id = xml.whole(track, "TRACK_ID", max_table_id);
    if (model.child("FilteredTracks") && !passed.contains(id)) continue;
    for (const pugi::xml_node& edge : track.children("Edge"))
      for (const char* end : {"SPOT_SOURCE_ID", "SPOT_TARGET_ID"}) {
        const int spot = xml.whole(edge, end, max_spot_id);
        if (!tracks.try_emplace(spot, id).second && tracks[spot] != id)
          xml.fail(edge.offset_debug(), "spot " + std::to_string(spot) + " is in two tracks");
      }
  }
  return tracks;
}

/// Scale, interval and height of the pictures; the size of a pixel in the unit of positions.
double take_image_data(const XmlSource& xml, const pugi::xml_node& root, TrackTable& table) {
  const pugi::xml_node model = root.child("Model");
  const pugi::xml_node image = root.child("Settings").child("ImageData");
  if (!image) return 1;
  const double width = xml.number(image, "pixelwidth", 1e-12, 1e12);
  const double height = xml.number(image, "pixelheight", 1e-12, 1e12);
  if (std::abs(height - width) > 1e-6 * width)
    xml.fail(image.offset_debug(), "pixels are no squares: pixelwidth is " + number_text(width) +
                                       ", pixelheight " + number_text(height));
  if (const auto unit = length_unit_um(model.attribute("spatialunits").value()))
    table.um_per_px = width * *unit;
  table.interval = to_interval(image.attribute("timeinterval"), model.attribute("timeunits"));
  if (image.attribute("height"))
    if (const int rows = xml.whole(image, "height", max_picture_height); rows > 0)
      table.height = rows;
  return width;
}

TrackTable saved_table(const XmlSource& xml, const pugi::xml_node& root) {
  TrackTable table;
  const double per_px = take_image_data(xml, root, table);
  const pugi::xml_node model = root.child("Model");
  const std::map<int, int> tracks = spot_tracks(xml, model);
  const bool has_tracks = !model.child("AllTracks").child("Track").empty();
  std::size_t found = 0;
  for (const pugi::xml_node& frame : model.child("AllSpots").children("SpotsInFrame"))
    for (const pugi::xml_node& spot : frame.children("Spot")) {
      const auto in_track = tracks.find(xml.whole(spot, "ID", max_spot_id));
      if (in_track != tracks.end()) ++found;
      if (in_track == tracks.end() && spot.attribute("VISIBILITY").as_int(1) == 0) continue;
      if (in_track == tracks.end() && has_tracks) {
        ++table.untracked;
        continue;
      }
      TableRow row{.frame = xml.whole(frame, "frame", max_table_frame),
                   .at_px = position(xml, spot, "POSITION_X", "POSITION_Y") / per_px};
      if (in_track != tracks.end()) row.id = in_track->second;
      table.rows.push_back(row);
    }
  if (found < tracks.size())
    xml.fail(model.child("AllTracks").offset_debug(),
             std::to_string(tracks.size() - found) + " spots of tracks are not in AllSpots");
  return table;
}

TrackTable exported_table(const XmlSource& xml, const pugi::xml_node& root,
                          std::optional<double> um_per_px) {
  TrackTable table;
  double per_px = 1;
  const std::string_view unit = root.attribute("spaceUnits").as_string("pixel");
  if (const auto size = length_unit_um(unit)) {
    if (!um_per_px)
      xml.fail(root.offset_debug(),
               "positions are in " + std::string(unit) + ": µm per px is missing");
    per_px = *um_per_px / *size;
  } else if (!is_pixel_unit(unit)) {
    xml.fail(root.offset_debug(), "unit " + quote(unit) + " is not known");
  }
  table.interval = to_interval(root.attribute("frameInterval"), root.attribute("timeUnits"));
  int id = 0;
  for (const pugi::xml_node& track : root.children("particle")) {
    if (id > max_table_id) xml.fail(track.offset_debug(), "more than 1e6 tracks");
    for (const pugi::xml_node& spot : track.children("detection"))
      table.rows.push_back({.frame = xml.whole(spot, "t", max_table_frame),
                            .id = id,
                            .at_px = position(xml, spot, "x", "y") / per_px});
    ++id;
  }
  return table;
}

}  // namespace

TrackTable parse_trackmate_xml(std::string_view text, std::string_view name,
                               std::optional<double> um_per_px) {
  const XmlSource xml(text, name);
  const pugi::xml_node root = xml.document().document_element();
  const std::string_view kind = root.name();
  if (kind == "TrackMate") return saved_table(xml, root);
  if (kind == "Tracks") return exported_table(xml, root, um_per_px);
  xml.fail(root.offset_debug(), "element " + quote(kind) + ", TrackMate or Tracks expected");
}

}  // namespace microswarm::vision
