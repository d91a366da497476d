// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "microswarm/rig/identify/recorded_response.hpp"

namespace microswarm::cli {

/// Fits of an identification and the values that they lead to.
struct Identification {
  rig::RecordedResponse response;
  rig::ResponseFit fit{};
  rig::StepOut sweep{};
  std::vector<rig::MeasuredValue> values{};
  std::vector<std::string> doubts{};  ///< why the values are not to be used
};

/// Prints a table: before, measured, after.
void print_identification(const Identification& of);
/// The same for --json.
nlohmann::ordered_json to_json(const Identification& of);
/// Draws identify.png, .svg and .pdf: the path, its parts over time, the speed over the frequency.
void draw_identification(const Identification& of, const std::filesystem::path& folder);

}  // namespace microswarm::cli
