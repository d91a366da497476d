// SPDX-License-Identifier: Apache-2.0
// Vessels in photographs, and robots in videos.
#include "microswarm/config/setting_keys.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/tracking/track_table.hpp"
#include "microswarm/vision/tracking/video_tracks.hpp"
#include "microswarm/vision/vessels/channel_graph.hpp"
#include "microswarm/vision/vessels/vessel_map.hpp"
#include "named_map.hpp"
#include "pictures.hpp"
#include "record.hpp"

namespace microswarm::python {
namespace {

/// Segments a photograph, an array or the name of a file.
py::dict segment(const py::object& photo, double um_per_px, double smooth, const Given& settings) {
  vision::VesselParams params;
  warn(set_values(params, to_settings(settings)));
  formats::Image image;
  std::string name = "image";
  if (py::isinstance<py::str>(photo)) {
    name = photo.cast<std::string>();
  } else {
    std::optional<int> depth;
    take_array(photo.cast<py::array>(), depth, name, image);
  }
  vision::VesselSegmentation found;
  Notes notes;
  Map map = interruptible([&](const Stop& stop) {
    if (image.pixels.empty()) {
      formats::ReadPicture read = formats::read_picture(name);
      image = std::move(read.image);
      notes = std::move(read.notes);
    }
    found = vision::segment_vessels(image, params, stop);
    return vision::vessel_map(found, um_per_px, smooth, name, stop);
  });
  if (std::string faint = vision::note_on_noise(found); !faint.empty())
    notes.push_back(name + ": " + faint);
  warn(notes);
  py::dict out;
  out["map"] = map_in_memory(std::move(map));
  out["mask"] = to_array(found.vessels);
  out["field_of_view"] = to_array(found.field_of_view);
  out["method"] = std::string(enum_name(found.method));
  out["polarity"] = std::string(enum_name(found.polarity));
  out["two_level_share"] = py::cast(found.two_level_share);
  out["polarity_odds"] = py::cast(found.polarity_odds);
  out["vessel_share"] = found.view_share;
  out["kept_share"] = found.kept_share;
  out["pieces"] = found.pieces;
  out["bridges"] = found.bridges;
  out["wide_width_um"] = found.wide_width_px * um_per_px;
  return out;
}

/// A column of a table: `value` of each item.
template <class T, class Items, class Value>
py::array_t<T> column(const Items& items, Value&& value) {
  py::array_t<T> out(static_cast<py::ssize_t>(items.size()));
  T* next = out.mutable_data();
  for (const auto& item : items) *next++ = static_cast<T>(value(item));
  return out;
}

py::tuple channel_graph(const NamedMap& map, double cell) {
  using Branch = vision::ChannelBranch;
  using Node = vision::ChannelNode;
  const vision::ChannelGraph graph =
      interruptible([&](const Stop& stop) { return vision::channel_graph(map.map(), cell, stop); });
  const auto& nodes = graph.nodes;
  py::dict branches;
  const auto whole = [&](const char* name, auto&& value) {
    branches[name] = column<std::int64_t>(graph.branches, value);
  };
  const auto real = [&](const char* name, auto&& value) {
    branches[name] = column<double>(graph.branches, value);
  };
  whole("branch", [i = 0](const Branch&) mutable { return ++i; });
  whole("network", [](const Branch& b) { return b.network; });
  whole("type", [](const Branch& b) { return static_cast<int>(b.type); });
  whole("node_a", [](const Branch& b) { return b.a + 1; });
  whole("node_b", [](const Branch& b) { return b.b + 1; });
  real("length_um", [](const Branch& b) { return b.length; });
  real("straight_um",
       [&](const Branch& b) { return distance(nodes[b.a].position, nodes[b.b].position); });
  real("mean_width_um", [](const Branch& b) { return b.mean_width; });
  real("min_width_um", [](const Branch& b) { return b.min_width; });
  real("max_width_um", [](const Branch& b) { return b.max_width; });
  real("narrowest_x_um", [](const Branch& b) { return b.narrowest.x; });
  real("narrowest_y_um", [](const Branch& b) { return b.narrowest.y; });
  py::dict ends;
  ends["node"] = column<std::int64_t>(nodes, [i = 0](const Node&) mutable { return ++i; });
  ends["network"] = column<std::int64_t>(nodes, [](const Node& n) { return n.network; });
  ends["degree"] = column<std::int64_t>(nodes, [](const Node& n) { return n.degree; });
  ends["x_um"] = column<double>(nodes, [](const Node& n) { return n.position.x; });
  ends["y_um"] = column<double>(nodes, [](const Node& n) { return n.position.y; });
  ends["width_um"] = column<double>(nodes, [](const Node& n) { return n.width; });
  return py::make_tuple(branches, ends);
}

vision::TrackSettings track_settings(const Given& given) {
  vision::TrackSettings settings;
  warn(set_values(settings, to_settings(given)));
  return settings;
}

py::dict to_dict(const std::vector<vision::TrackEvent>& events) {
  const auto count = static_cast<py::ssize_t>(events.size());
  py::array_t<std::int64_t> frames(count), ids(count), others(count);
  py::list words;
  for (py::ssize_t i = 0; i < count; ++i) {
    const vision::TrackEvent& event = events[static_cast<std::size_t>(i)];
    frames.mutable_at(i) = event.frame;
    ids.mutable_at(i) = event.id;
    others.mutable_at(i) = event.other.value_or(-1);
    words.append(std::string(enum_name(event.change)));
  }
  py::dict out;
  out["frame"] = frames;
  out["event"] = py::module_::import("numpy").attr("array")(words, py::dtype("U5"));
  out["particle"] = ids;
  out["other"] = others;
  return out;
}

py::dict to_tracks(const vision::TrackResult& result) {
  py::dict out;
  out["rows"] = columns_of_list({&type_of<std::vector<vision::TrackRow>>(), &result.rows});
  out["events"] = to_dict(result.events);
  out["frames"] = result.frames;
  out["unsettled"] = result.unsettled;
  out["notes"] = result.notes;
  out["search_range_um"] = search_range(result.settings);
  out["is_noise"] = vision::looks_like_noise(summarise(result.rows, result.frames));
  return out;
}

/// Tracks robots in pictures that the caller passes one by one.
class ArrayTracker {
 public:
  explicit ArrayTracker(const Given& settings)
      : result_{.settings = track_settings(settings),
                .promised = {},
                .times = {},
                .notes = {},
                .rows = {},
                .events = {}},
        tracker_(result_.settings, 1 / result_.settings.rate.value_or(1)) {}

  void step(const py::array& array, const std::optional<double>& t) {
    const std::string name = "frame " + std::to_string(result_.frames);
    take_array(array, result_.settings.depth, name, frame_.picture);
    const formats::Image& picture = frame_.picture;
    if (result_.frames == 0) {
      width_ = picture.width;
      height_ = picture.height;
    }
    if (picture.width != width_ || picture.height != height_)
      throw InputError(name, std::to_string(picture.height) + " × " +
                                 std::to_string(picture.width) + " pixels, the first has " +
                                 std::to_string(height_) + " × " + std::to_string(width_));
    const Free free;
    frame_.index = result_.frames;
    frame_.t = t.value_or(frame_.index / result_.settings.rate.value_or(1));
    const std::vector<vision::TrackRow>& rows = tracker_.step(frame_);
    result_.rows.insert(result_.rows.end(), rows.begin(), rows.end());
    ++result_.frames;
  }
  py::dict finish() {
    tracker_.finish();
    vision::take_velocities(result_.rows);
    result_.events = tracker_.events();
    result_.unsettled = tracker_.unsettled();
    result_.notes = tracker_.doubts(vision::summarise(result_.rows, result_.frames));
    return to_tracks(result_);
  }

 private:
  vision::TrackResult result_;
  vision::VideoTracker tracker_;
  vision::VideoFrame frame_;
  int width_ = 0, height_ = 0;
};

/// Tracks of a table of another program.
vision::TrackResult tracks_of_file(const std::string& file, vision::TrackSettings settings,
                                   const std::string& times) {
  if (settings.region) throw InputError(file, "is a table, region needs pictures");
  if (!times.empty()) throw InputError(file, "is a table, times_s needs pictures");
  const vision::TrackTable table = vision::read_track_table(file, settings.um_per_px);
  if (!settings.um_per_px) settings.um_per_px = table.um_per_px;
  if (!settings.um_per_px) throw InputError(file, "states no scale: give um_per_px");
  if (!settings.rate && !table.rows.front().t && !table.interval)
    throw InputError(file, "states no times: give fps");
  vision::TrackResult result = vision::tracks_of_table(table, file, settings);
  if (!table.rows.front().id)
    result.notes.push_back(file + ": has no tracks, its positions are linked");
  if (table.untracked > 0)
    result.notes.push_back(file + ": " + std::to_string(table.untracked) +
                           " positions in no track are left out");
  return result;
}

/// Tracks the robots of a video file or a folder of pictures, or takes those of a table.
py::dict track_file(const std::string& file, const Given& given, const std::string& times,
                    const py::object& report) {
  const vision::TrackSettings settings = track_settings(given);
  std::atomic<double> done = 0;
  std::string ended;
  const auto work = [&](const Stop& stop) {
    if (vision::is_track_table(file)) return tracks_of_file(file, settings, times);
    const auto frames = vision::open_frames(file, vision::frame_options(settings, times));
    if (!frames->rate()) throw InputError(file, "states no times: give fps or times_s");
    if (!settings.um_per_px && !frames->um_per_px())
      throw InputError(file, "states no scale: give um_per_px");
    const double all = frames->count().value_or(0);
    vision::TrackResult result = vision::track_video(
        *frames, file, settings,
        [&](const vision::VideoFrame& frame, const std::vector<vision::TrackRow>&) {
          if (all > 0) done = std::min(1.0, (frame.index + 1) / all);
        },
        stop);
    ended = frames->why_ended();
    if (ended.empty() && result.frames + 1 < result.promised.value_or(0))
      ended = file + ": says that it has " + std::to_string(*result.promised) + " pictures";
    return result;
  };
  const vision::TrackResult result = interruptible(work, [&] {
    if (!report.is_none()) report(done.load());
  });
  py::dict out = to_tracks(result);
  out["ended"] = ended;
  return out;
}

std::vector<std::string> track_keys() {
  std::vector<std::string> keys;
  for (const SettingKey& key : setting_keys(type_of<vision::TrackSettings>()))
    keys.push_back(key.key);
  return keys;
}

}  // namespace

void add_vision(py::module_& module) {
  module.def("segment", segment);
  module.def("channel_graph", channel_graph);
  module.def("track_file", track_file);
  module.def("track_keys", track_keys);
  module.def("check_image_size",
             [](std::int64_t width, std::int64_t height, const std::string& name) {
               formats::check_image_size(width, height, name);
             });
  py::class_<ArrayTracker>(module, "ArrayTracker")
      .def(py::init<const Given&>())
      .def("step", &ArrayTracker::step)
      .def("finish", &ArrayTracker::finish);
}

}  // namespace microswarm::python
