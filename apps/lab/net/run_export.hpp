// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "lab/files/download.hpp"
#include "lab/stream/stream.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/report/run_video.hpp"

namespace microswarm::lab {

/// A video or a picture of a run, which takes longer than other downloads.
struct RunExport {
  enum class Kind { video, gif, picture };
  Kind kind = Kind::picture;
  report::RunVideoOptions options{};
  std::optional<BackgroundPhoto> photo{};
  double t = 0;  ///< time of a picture [s]
};

/// Parses run.mp4 or run.gif?from=&to=&speed=&width= or picture.svg?t=&width=; nothing for another
/// name. Throws InputError for an invalid number.
std::optional<RunExport> read_run_export(std::string_view name, std::string_view target);

/// Makes the export. Throws InputError if it fails or was stopped. `show` gets the completed share.
Download make_run_export(const RunExport& wanted, const experiment::Record& record,
                         const Stop& stop, const std::function<void(double share)>& show = {});

}  // namespace microswarm::lab
