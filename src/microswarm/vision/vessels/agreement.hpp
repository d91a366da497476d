// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "microswarm/formats/images/mask.hpp"

namespace microswarm::vision {

/// Pixelwise confusion matrix of a mask and a ground-truth mask.
struct Agreement {
  std::int64_t true_positive = 0;
  std::int64_t false_positive = 0;
  std::int64_t true_negative = 0;
  std::int64_t false_negative = 0;

  /// True positives as a fraction of the true pixels; empty if there are none.
  std::optional<double> sensitivity() const;
  /// True negatives as a fraction of the other pixels; empty if there are none.
  std::optional<double> specificity() const;
  /// Twice the intersection divided by the sum of both areas; empty if both are empty.
  std::optional<double> dice() const;
};

/// Compares `test` with `truth` inside `view`, or everywhere if it is null. Throws InputError if
/// the sizes differ.
Agreement compare(const formats::Mask& truth, const formats::Mask& test,
                  const formats::Mask* view = nullptr);

}  // namespace microswarm::vision
