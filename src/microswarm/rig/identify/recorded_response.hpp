// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "microswarm/config/settings.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/rig/commissioning/commissioning.hpp"
#include "microswarm/rig/identify/response_fit.hpp"

namespace microswarm::rig {

/// Commands and sightings of a recorded run, and the rig as it was. Throws InputError if the record
/// is not of a rig.
struct RecordedResponse {
  explicit RecordedResponse(const experiment::Record& record);

  RigParams rig{};
  ResponseData data{};
};

/// A measured value for a rig's file, in the unit of its key.
struct MeasuredValue {
  Quantity what = Quantity::gain;
  std::string key{};  ///< of the rig's file
  std::string unit{};
  std::optional<double> before{};  ///< in the rig's file
  double after = 0;                ///< to be written
  double error = 0;                ///< standard error of `after`; 0 if it is a bound
  std::string measured{};          ///< in words, with the standard error: "0.6 ± 0.01"

  /// "field.speed_per_pitch_um_per_s: 687.55".
  Setting setting() const;
};

/// Values that the fits lead to. `driven` is the rig as it was driven, `file` as it is in its file.
/// A step-out frequency that was not met is none.
std::vector<MeasuredValue> measured_values(const RigParams& driven, const RigParams& file,
                                           const ResponseFit& fit, const StepOut& sweep);

/// The step-out frequency in words: "18 to 20 Hz", "≥ 24 Hz", "< 8 Hz", or empty without a sweep.
std::string step_out_text(const StepOut& sweep);

}  // namespace microswarm::rig
