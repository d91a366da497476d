// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "microswarm/formats/images/tiff_description.hpp"
#include "microswarm/vision/camera/frames.hpp"

namespace microswarm::vision {

/// Pages of a stack in the order of time.
struct StackPages {
  std::vector<int> pages{};     ///< from 0
  std::vector<int> steps{};     ///< number of each along the axis of time, ascending from 0
  int pixel_channel = 0;        ///< among the samples of a pixel
  bool has_gaps = false;        ///< numbers are missing within `steps`
  std::vector<double> times{};  ///< of each [s] as the file says; empty without
  std::vector<std::string> notes{};
};

/// Chooses those of one channel and slice among `count` pages. Planes that are in other files are
/// left out; if this file holds one channel or slice, that is chosen. Slices of a stack without
/// times are taken as times, as ImageJ stores a plain stack, unless one is chosen. Where ImageJ's
/// counts do not fit the pages, its order, which is always the same, says what they are. Throws
/// InputError "NAME: WHY" if there are several and none is chosen, or one that is not there.
StackPages choose_pages(const formats::TiffDescription& description, int count,
                        const FrameOptions& options, const std::string& name);

}  // namespace microswarm::vision
