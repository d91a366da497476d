// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/stack_pages.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::vision {
namespace {

/// Index of a channel, slice or time, from 0, and their number.
struct Axis {
  int at = 0;
  int size = 1;
};

/// Pages of one place along C and Z, in the order of time.
std::vector<int> pages_at(const std::string& order, const Axis& c, const Axis& z, int times) {
  std::vector<int> pages;
  for (int t = 0; t < times; ++t) {
    int page = 0, stride = 1;
    for (const char axis : order) {
      page += stride * (axis == 'C' ? c.at : axis == 'Z' ? z.at : t);
      stride *= axis == 'C' ? c.size : axis == 'Z' ? z.size : times;
    }
    pages.push_back(page);
  }
  return pages;
}

}  // namespace

StackPages choose_pages(const formats::TiffDescription& d, int count, const FrameOptions& options,
                        const std::string& name) {
  StackPages chosen;
  const auto fail = [&](const std::string& why) { throw InputError(name + ": " + why); };
  const auto choose = [&](std::string_view what, std::string_view key, std::optional<int> given,
                          int size) {
    if (given && (*given < 1 || *given > size))
      fail(fmt::format("{} is {}, the stack has {} {}{}", key, *given, size, what,
                       size == 1 ? "" : "s"));
    if (!given && size > 1)
      fail(fmt::format("holds {} {}s of {} pictures in all: choose one with {}, 1 to {}", size,
                       what, count, key, size));
    return Axis{given.value_or(1) - 1, size};
  };
  // A description that does not fit its own count says nothing about the order of the pages.
  const double told = static_cast<double>(d.channels) * d.slices * d.times;
  const bool fits = !d.software.empty() && told == d.images && d.images >= count;
  if (!fits && told > 1)
    chosen.notes.push_back(fmt::format(
        "{} tells {} channels, {} slices and {} times of {} pictures: all are taken as times",
        d.software, d.channels, d.slices, d.times, count));
  Axis c, z;
  int times = count;
  if (fits || options.stack_channel)
    c = choose("channel", "stack_channel", options.stack_channel, fits ? d.channels : 1);
  if (fits && d.slices > 1 && d.times == 1 && !options.slice) {
    times = d.slices;
    chosen.notes.push_back(fmt::format(
        "its {} slices are taken as times, as a plain stack is stored; slice chooses one",
        d.slices));
    std::string order;
    for (const char axis : d.order)
      if (axis == 'C' || axis == 'Z') order += axis == 'Z' ? 'T' : 'C';
    chosen.pages = pages_at(order, c, z, times);
  } else if (fits) {
    z = choose("slice", "slice", options.slice, d.slices);
    chosen.pages = pages_at(d.order, c, z, d.times);
  } else {
    if (options.slice) z = choose("slice", "slice", options.slice, 1);
    chosen.pages = pages_at("T", c, z, count);
  }
  std::erase_if(chosen.pages, [&](int page) { return page >= count; });
  if (chosen.pages.empty()) fail(fmt::format("its {} pictures hold none of those chosen", count));
  for (const int page : chosen.pages) {
    const auto at = static_cast<std::size_t>(page);
    if (!fits || at >= d.page_times.size() || !d.page_times[at]) break;
    if (!chosen.times.empty() && !(*d.page_times[at] > chosen.times.back())) break;
    chosen.times.push_back(*d.page_times[at]);
  }
  if (chosen.times.size() != chosen.pages.size()) chosen.times.clear();
  return chosen;
}

}  // namespace microswarm::vision
