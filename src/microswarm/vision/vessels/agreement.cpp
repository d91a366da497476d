// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/agreement.hpp"

#include <string>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::vision {
namespace {

std::optional<double> share(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

void require_same_size(const formats::Mask& a, const formats::Mask& b) {
  if (a.width == b.width && a.height == b.height) return;
  const auto size = [](const formats::Mask& m) {
    return std::to_string(m.width) + "x" + std::to_string(m.height);
  };
  throw InputError("masks to compare: " + size(b) + " pixels, expected " + size(a));
}

}  // namespace

std::optional<double> Agreement::sensitivity() const {
  return share(true_positive, true_positive + false_negative);
}

std::optional<double> Agreement::specificity() const {
  return share(true_negative, true_negative + false_positive);
}

std::optional<double> Agreement::dice() const {
  return share(2 * true_positive, 2 * true_positive + false_positive + false_negative);
}

Agreement compare(const formats::Mask& truth, const formats::Mask& test,
                  const formats::Mask* view) {
  require_same_size(truth, test);
  if (view) require_same_size(truth, *view);
  Agreement result;
  for (std::size_t i = 0; i < truth.cells.size(); ++i) {
    if (view && !view->cells[i]) continue;
    if (truth.cells[i])
      ++(test.cells[i] ? result.true_positive : result.false_negative);
    else
      ++(test.cells[i] ? result.false_positive : result.true_negative);
  }
  return result;
}

}  // namespace microswarm::vision
