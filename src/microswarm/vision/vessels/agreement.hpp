// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "microswarm/formats/images/mask.hpp"

namespace microswarm {

/// How well one mask tells what another holds for true, pixel by pixel.
struct Agreement {
  std::int64_t true_positive = 0;
  std::int64_t false_positive = 0;
  std::int64_t true_negative = 0;
  std::int64_t false_negative = 0;

  /// Share of the true pixels that were found; nothing when there is none.
  std::optional<double> sensitivity() const;
  /// Share of the other pixels that were left alone; nothing when there is none.
  std::optional<double> specificity() const;
  /// Twice the common area over the sum of both areas; nothing when both are empty.
  std::optional<double> dice() const;
};

/// Compares `test` with `truth` where `view` is set, everywhere without it. Throws InputError when
/// the sizes differ.
Agreement compare(const Mask& truth, const Mask& test, const Mask* view = nullptr);

}  // namespace microswarm
