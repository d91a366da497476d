// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/validate_prediction.hpp"

#include <fmt/format.h>

#include <string_view>

namespace microswarm::navigation {
namespace {

/// An issue if the value of the first key is not less than that of the second.
void require_less(double a, double b, std::string_view first, std::string_view second,
                  Issues& issues) {
  constexpr std::string_view group = "prediction.tuning";
  if (a < b) return;
  issues.add(fmt::format("{}.{}", group, first),
             fmt::format("{0}.{1} must be less than {0}.{2}", group, first, second));
}

}  // namespace

Issues validate_prediction(const MultiModelPredictorParams& params) {
  Issues issues;
  const OscillationTuning& o = params.tuning.oscillation;
  require_less(o.short_window, o.medium_window, "oscillation.short_window_s",
               "oscillation.medium_window_s", issues);
  require_less(o.medium_window, o.long_window, "oscillation.medium_window_s",
               "oscillation.long_window_s", issues);
  require_less(o.min_frequency, o.max_frequency, "oscillation.min_frequency_per_s",
               "oscillation.max_frequency_per_s", issues);
  // A recurrence must lie in the past.
  const RecurrenceTuning& r = params.tuning.recurrence;
  require_less(r.max_time_offset, r.min_age, "recurrence.max_time_offset_s", "recurrence.min_age_s",
               issues);
  return issues;
}

}  // namespace microswarm::navigation
