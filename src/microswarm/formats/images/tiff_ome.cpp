// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/tiff_ome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <set>

#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/core/text/unit_names.hpp"

namespace microswarm::formats {
namespace {

/// Name of an element without the prefix of its namespace.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(name.find(':') + 1);
}

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  return node.find_child([&](const pugi::xml_node& c) { return local_name(c) == name; });
}

/// Calls `use` with each child of this name.
template <class Use>
void each_child(const pugi::xml_node& node, std::string_view name, Use&& use) {
  for (const pugi::xml_node& c : node.children())
    if (local_name(c) == name) use(c);
}

/// A quantity of an element: its attribute times the unit that NAMEUnit names.
std::optional<double> quantity(const pugi::xml_node& node, const std::string& name,
                               std::optional<double> (*unit_size)(std::string_view),
                               std::string_view usual_unit) {
  const std::string_view unit = node.attribute((name + "Unit").c_str()).as_string();
  const auto size = unit_size(unit.empty() ? usual_unit : unit);
  const std::string_view text = node.attribute(name.c_str()).as_string();
  if (!size || text.empty()) return std::nullopt;
  const auto value = parse_number(text);
  if (!value) return std::nullopt;
  return *value * *size;
}

int samples_in_pixel(const pugi::xml_node& pixels) {
  return count_in_text(child(pixels, "Channel").attribute("SamplesPerPixel").as_string());
}

/// Takes the sizes and the order of an image; false if it has too many pictures.
bool take_sizes(const pugi::xml_node& pixels, TiffDescription& d) {
  const auto size = [&](const char* name) {
    return count_in_text(pixels.attribute(name).as_string());
  };
  d.channels = std::max(1, size("SizeC") / samples_in_pixel(pixels));
  d.slices = size("SizeZ");
  d.times = size("SizeT");
  const double images = static_cast<double>(d.channels) * d.slices * d.times;
  if (images > max_tiff_images) return false;
  d.images = static_cast<int>(images);
  const std::string order = pixels.attribute("DimensionOrder").as_string("XYCZT");
  if (order.size() == 5 && order.starts_with("XY") &&
      std::ranges::all_of(d.order, [&](char axis) { return order.find(axis) != order.npos; }))
    d.order = order.substr(2);
  return true;
}

/// Number of a plane in the order of planes by what `at` says of an axis; nothing beyond a size.
template <class At>
std::optional<int> plane_number(const TiffDescription& d, At&& at) {
  int plane = 0, stride = 1;
  for (const char axis : d.order) {
    const int size = d.size_of(axis), place = at(axis);
    if (place < 0 || place >= size) return std::nullopt;
    plane += place * stride;
    stride *= size;
  }
  return plane;
}

std::vector<std::optional<double>> plane_times(const pugi::xml_node& pixels,
                                               const TiffDescription& d) {
  std::vector<std::optional<double>> times(static_cast<std::size_t>(d.images));
  bool any = false, good = true;
  each_child(pixels, "Plane", [&](const pugi::xml_node& plane) {
    const auto number = plane_number(d, [&](char axis) {
      return plane.attribute((std::string("The") + axis).c_str()).as_int(-1);
    });
    good = good && number;
    if (!good) return;
    auto& t = times[static_cast<std::size_t>(*number)];
    t = quantity(plane, "DeltaT", time_unit_s, "s");
    any = any || t;
  });
  if (!any || !good) times.clear();
  return times;
}

/// A run of planes in the order of planes that lies in consecutive pages: an element TiffData.
struct PlaneRun {
  int first = 0;                ///< plane
  int page = 0;                 ///< of the first
  std::optional<int> count;     ///< all that there are without
  std::string_view uuid, file;  ///< where it lies; empty: here
};

/// Runs of planes of an image. What cannot be read is reported in `fault`.
std::vector<PlaneRun> plane_runs(const pugi::xml_node& pixels, const TiffDescription& d,
                                 std::string& fault) {
  std::vector<PlaneRun> runs;
  const int in_pixel = samples_in_pixel(pixels);
  each_child(pixels, "TiffData", [&](const pugi::xml_node& data) {
    PlaneRun run;
    const auto first = plane_number(d, [&](char axis) {
      const int at = data.attribute((std::string("First") + axis).c_str()).as_int(0);
      return axis == 'C' ? at / in_pixel : at;
    });
    const pugi::xml_attribute page = data.attribute("IFD");
    pugi::xml_attribute count = data.attribute("PlaneCount");
    if (!count) count = data.attribute("NumPlanes");  // before 2008
    run.page = page.as_int(0);
    if (count)
      run.count = count.as_int(-1);
    else if (page)
      run.count = 1;
    if (!first || run.page < 0 || run.page >= max_tiff_images || run.count.value_or(0) < 0 ||
        run.count.value_or(0) > d.images - *first)
      fault = "a TiffData names a picture that is not among its own sizes";
    else
      run.first = *first;
    const pugi::xml_node uuid = child(data, "UUID");
    run.uuid = trimmed(uuid.text().as_string());
    run.file = uuid.attribute("FileName").as_string();
    runs.push_back(run);
  });
  return runs;
}

std::string_view without_folder(std::string_view path) {
  return path.substr(path.find_last_of("/\\") + 1);  // npos + 1 is 0
}

/// Which runs lie in the file at hand.
class Places {
 public:
  Places(const std::vector<PlaneRun>& runs, std::string_view uuid, std::string_view file_name)
      : uuid_(uuid), file_name_(without_folder(file_name)) {
    std::set<std::string_view> names;
    bool is_known = false;
    for (const PlaneRun& run : runs) {
      names.insert(run.file.empty() ? run.uuid : run.file);
      is_known = is_known || is_certain(run);
    }
    is_only_ = !is_known && names.size() == 1;  // one file that has another name now
  }
  bool is_here(const PlaneRun& run) const { return is_only_ || is_certain(run); }

 private:
  bool is_certain(const PlaneRun& run) const {
    if (run.uuid.empty() && run.file.empty()) return true;
    if (!uuid_.empty() && !run.uuid.empty()) return run.uuid == uuid_;
    return without_folder(run.file) == file_name_;
  }
  std::string_view uuid_, file_name_;
  bool is_only_ = false;
};

void name_file(TiffDescription& d, const PlaneRun& run) {
  const std::string name(run.file.empty() ? run.uuid : run.file);
  if (std::ranges::find(d.other_files, name) == d.other_files.end()) d.other_files.push_back(name);
}

/// Takes the pages of the planes from the elements TiffData; false if they contradict themselves.
bool take_map(const std::vector<PlaneRun>& runs, const Places& places, TiffDescription& d,
              std::string& fault) {
  d.plane_pages.assign(static_cast<std::size_t>(d.images), -1);
  std::set<int> used;
  for (const PlaneRun& run : runs) {
    if (!places.is_here(run)) {
      name_file(d, run);
      continue;
    }
    const int count = run.count.value_or(d.images - run.first);
    for (int k = 0; k < count; ++k) {
      int& page = d.plane_pages[static_cast<std::size_t>(run.first + k)];
      if (page >= 0 || !used.insert(run.page + k).second) {
        fault = "two TiffData name the same picture";
        return false;
      }
      page = run.page + k;
    }
  }
  return true;
}

/// Pages that the images of a file take up in it, by their sizes or by TiffData.
double pages_of_all(const pugi::xml_node& root, std::string_view uuid, std::string_view file_name,
                    bool mapped) {
  double pages = 0;
  each_child(root, "Image", [&](const pugi::xml_node& image) {
    const pugi::xml_node pixels = child(image, "Pixels");
    TiffDescription d;
    if (!pixels || !take_sizes(pixels, d)) return;
    std::string fault;
    const std::vector<PlaneRun> runs = plane_runs(pixels, d, fault);
    if (!mapped || runs.empty()) {
      pages += d.images;
      return;
    }
    const Places places(runs, uuid, file_name);
    for (const PlaneRun& run : runs)
      if (places.is_here(run))
        pages = std::max(pages,
                         static_cast<double>(run.page) + run.count.value_or(d.images - run.first));
  });
  return std::min<double>(pages, max_tiff_images);
}

void take_pages(const pugi::xml_node& root, const pugi::xml_node& pixels,
                std::string_view file_name, TiffDescription& d) {
  const std::string_view uuid = trimmed(root.attribute("UUID").as_string());
  std::string fault;
  const std::vector<PlaneRun> runs = plane_runs(pixels, d, fault);
  const bool is_mapped =
      !runs.empty() && fault.empty() && take_map(runs, {runs, uuid, file_name}, d, fault);
  const int images = d.images;
  d.images = static_cast<int>(pages_of_all(root, uuid, file_name, is_mapped));
  if (is_mapped) return;
  d.plane_pages.clear();
  d.other_files.clear();
  if (!fault.empty())
    d.notes.push_back(fmt::format(
        "{}: the order of the pages in the file is taken, which may not be that of time", fault));
  for (int page = 0; page < images && images < d.images; ++page) d.plane_pages.push_back(page);
}

}  // namespace

bool is_ome(std::string_view text) {
  return text.find("<OME") != text.npos ||
         (text.find(":OME") != text.npos && text.find("openmicroscopy.org") != text.npos);
}

TiffDescription parse_ome(std::string_view text, std::string_view file_name) {
  TiffDescription d{.software = "OME"};
  const auto without = [&](std::string why) {
    TiffDescription nothing{.software = "OME"};
    nothing.notes.push_back(std::move(why) + ": the pages are taken as times");
    return nothing;
  };
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size()))
    return without("its OME description cannot be read");
  const pugi::xml_node root = child(document, "OME");
  if (const pugi::xml_node binary = child(root, "BinaryOnly"))
    return without(fmt::format("its OME description is in another file, {}",
                               binary.attribute("MetadataFile").as_string("which is not named")));
  const pugi::xml_node pixels = child(child(root, "Image"), "Pixels");
  if (!pixels || !take_sizes(pixels, d)) return without("its OME description states no pictures");
  int images = 0;
  each_child(root, "Image", [&](const pugi::xml_node&) { ++images; });
  if (images > 1)
    d.notes.push_back(fmt::format("OME states {} images in it: the first is read", images));
  const auto above_0 = [](std::optional<double> v) { return v && *v > 0 ? v : std::nullopt; };
  d.um_per_px = above_0(quantity(pixels, "PhysicalSizeX", length_unit_um, "µm"));
  d.um_per_px_y = above_0(quantity(pixels, "PhysicalSizeY", length_unit_um, "µm"));
  d.interval = above_0(quantity(pixels, "TimeIncrement", time_unit_s, "s"));
  d.page_times = plane_times(pixels, d);
  take_pages(root, pixels, file_name, d);
  return d;
}

}  // namespace microswarm::formats
