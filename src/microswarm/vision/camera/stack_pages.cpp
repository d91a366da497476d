// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/stack_pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::vision {
namespace {

/// Index of a channel, slice or time, from 0, and their number.
struct Axis {
  int at = 0;
  int size = 1;
};

/// Planes of one place along C and Z, in the order of time.
std::vector<int> planes_at(const std::string& order, const Axis& c, const Axis& z, int times) {
  std::vector<int> planes;
  for (int t = 0; t < times; ++t) {
    int plane = 0, stride = 1;
    for (const char axis : order) {
      plane += stride * (axis == 'C' ? c.at : axis == 'Z' ? z.at : t);
      stride *= axis == 'C' ? c.size : axis == 'Z' ? z.size : times;
    }
    planes.push_back(plane);
  }
  return planes;
}

/// Index along an axis that all planes in this file share; nothing if they differ, or all are here.
std::optional<int> only_one_here(const formats::TiffDescription& d, char axis) {
  int stride = 1;
  for (const char faster : d.order.substr(0, d.order.find(axis))) stride *= d.size_of(faster);
  std::optional<int> only;
  for (std::size_t plane = 0; plane < d.plane_pages.size(); ++plane) {
    if (d.plane_pages[plane] < 0) continue;
    const int at = static_cast<int>(plane) / stride % d.size_of(axis);
    if (only.value_or(at) != at) return std::nullopt;
    only = at;
  }
  return only;
}

std::string names_of(const std::vector<std::string>& files) {
  constexpr std::size_t most = 3;
  std::string names;
  for (std::size_t k = 0; k < std::min(most, files.size()); ++k)
    names += (k == 0 ? "" : ", ") + files[k];
  return names + (files.size() > most ? ", ..." : "");
}

/// Chooses the pages of one stack.
class PageChoice {
 public:
  PageChoice(const formats::TiffDescription& d, int count, const FrameOptions& options,
             const std::string& name)
      : d_(d), count_(count), options_(options), name_(name) {}

  StackPages run() {
    chosen_.notes = d_.notes;
    mend_imagej_counts();
    // A description that does not fit its own count says nothing about the order of the pages.
    const double told = static_cast<double>(d_.channels) * d_.slices * d_.times;
    fits_ = !d_.software.empty() &&
            (d_.plane_pages.empty() ? told == d_.images : told == planes_told()) &&
            (d_.images >= count_ || !d_.plane_pages.empty());
    if (!fits_ && d_.channels > 1 && options_.stack_channel)
      fail(fmt::format(
          "{} states {} channels, {} slices and {} times of {} pictures, which does not fit: no "
          "channel can be chosen",
          d_.software, d_.channels, d_.slices, d_.times, count_));
    if (!fits_ && told > 1)
      chosen_.notes.push_back(fmt::format(
          "{} states {} channels, {} slices and {} times of {} pictures: all are taken as times",
          d_.software, d_.channels, d_.slices, d_.times, count_));
    take(planes());
    take_times();
    return std::move(chosen_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw InputError(name_, why); }
  double planes_told() const { return static_cast<double>(d_.plane_pages.size()); }

  /// The pages of ImageJ are channels first, then slices, then times, for any counts.
  void mend_imagej_counts() {
    const double in_a_time = static_cast<double>(d_.channels) * d_.slices;
    if (d_.software != "ImageJ" || in_a_time < 2) return;
    const bool fits = in_a_time * d_.times == d_.images && d_.images >= count_;
    // Counts of slices and times alone may be those of a plain stack.
    if (fits || d_.channels < 2 || in_a_time > count_) return;
    chosen_.notes.push_back(fmt::format(
        "ImageJ states {} channels, {} slices and {} times of {} pictures: the pages are "
        "taken in its order, channels first",
        d_.channels, d_.slices, d_.times, count_));
    d_.times = static_cast<int>(std::ceil(count_ / in_a_time));
    d_.images = static_cast<int>(in_a_time) * d_.times;
  }

  Axis choose(std::string_view what, std::string_view key, std::optional<int> given, char axis) {
    const int in_pixel = axis == 'C' ? d_.pixel_channels : 1;
    const int size = (fits_ ? d_.size_of(axis) : 1) * in_pixel;
    if (given && (*given < 1 || *given > size))
      fail(fmt::format("{} is {}, the stack has {} {}{}", key, *given, size, what,
                       size == 1 ? "" : "s"));
    if (given || size == 1) return {given.value_or(1) - 1, size};
    if (const std::optional<int> only = only_one_here(d_, axis); only && in_pixel == 1) {
      chosen_.notes.push_back(
          fmt::format("of {} {}s only number {} is in this file", size, what, *only + 1));
      return {*only, size};
    }
    fail(fmt::format("holds {} {}s of {} pictures in all: choose one with {}, 1 to {}", size, what,
                     count_, key, size));
  }

  /// Planes that are wanted, in the order of time.
  std::vector<int> planes() {
    Axis c, z;
    if (fits_ || options_.stack_channel || d_.pixel_channels > 1)
      c = choose("channel", "stack_channel", options_.stack_channel, 'C');
    chosen_.pixel_channel = c.at % d_.pixel_channels;
    c = {c.at / d_.pixel_channels, c.size / d_.pixel_channels};
    if (fits_ && d_.slices > 1 && d_.times == 1 && !options_.slice) {
      chosen_.notes.push_back(fmt::format(
          "its {} slices are taken as times, as a plain stack is stored; slice chooses one",
          d_.slices));
      std::string order;
      for (const char axis : d_.order)
        if (axis == 'C' || axis == 'Z') order += axis == 'Z' ? 'T' : 'C';
      return planes_at(order, c, z, d_.slices);
    }
    if (fits_ || options_.slice) z = choose("slice", "slice", options_.slice, 'Z');
    return fits_ ? planes_at(d_.order, c, z, d_.times) : planes_at("T", c, z, count_);
  }

  /// Takes the pages of those planes that are in this file.
  void take(const std::vector<int>& planes) {
    const std::vector<int> none;
    const std::vector<int>& pages = fits_ ? d_.plane_pages : none;
    int elsewhere = 0;
    for (std::size_t step = 0; step < planes.size(); ++step) {
      const auto plane = static_cast<std::size_t>(planes[step]);
      const int page = pages.empty() ? planes[step] : pages[plane];
      if (page < 0) ++elsewhere;
      if (page < 0 || page >= count_) continue;
      chosen_.pages.push_back(page);
      planes_.push_back(plane);
      chosen_.steps.push_back(static_cast<int>(step));
    }
    const std::string where =
        d_.other_files.empty() ? "nowhere" : "in other files, " + names_of(d_.other_files);
    if (chosen_.pages.empty() && elsewhere > 0)
      fail(fmt::format("none of the pictures chosen is in this file: {} says that they are {}",
                       d_.software, where));
    if (chosen_.pages.empty())
      fail(fmt::format("its {} pictures hold none of those chosen", count_));
    if (elsewhere > 0 || !d_.other_files.empty())
      chosen_.notes.push_back(
          fmt::format("{} names pictures that are {}: they are left out", d_.software, where));
    if (!pages.empty() && count_ > d_.images)
      chosen_.notes.push_back(
          fmt::format("its last {} pictures are not in what {} states: "
                      "they are left out",
                      count_ - d_.images, d_.software));
    const int first = chosen_.steps.front();
    for (int& step : chosen_.steps) step -= first;
    chosen_.has_gaps = chosen_.steps.back() + 1 > static_cast<int>(chosen_.steps.size());
    if (chosen_.has_gaps)
      chosen_.notes.push_back(
          fmt::format("{} of {} times are in this file: the others are gaps in time",
                      chosen_.steps.size(), chosen_.steps.back() + 1));
  }

  void take_times() {
    for (const std::size_t plane : planes_) {
      if (!fits_ || plane >= d_.page_times.size() || !d_.page_times[plane]) break;
      if (!chosen_.times.empty() && !(*d_.page_times[plane] > chosen_.times.back())) break;
      chosen_.times.push_back(*d_.page_times[plane]);
    }
    if (chosen_.times.size() != chosen_.pages.size()) chosen_.times.clear();
  }

  formats::TiffDescription d_;
  int count_;
  const FrameOptions& options_;
  const std::string& name_;
  bool fits_ = false;
  std::vector<std::size_t> planes_;  ///< of the pages chosen
  StackPages chosen_;
};

}  // namespace

StackPages choose_pages(const formats::TiffDescription& d, int count, const FrameOptions& options,
                        const std::string& name) {
  return PageChoice(d, count, options, name).run();
}

}  // namespace microswarm::vision
