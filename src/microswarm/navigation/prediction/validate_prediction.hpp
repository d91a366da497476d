// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor_params.hpp"

namespace microswarm::navigation {

/// Reports bounds of a navigator's group `prediction` that do not ascend.
Issues validate_prediction(const MultiModelPredictorParams& params);

}  // namespace microswarm::navigation
