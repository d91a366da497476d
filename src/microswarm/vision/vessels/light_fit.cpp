// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/light_fit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace microswarm::vision {
namespace {

constexpr int max_degree = 4;
constexpr int max_terms = (max_degree + 1) * (max_degree + 2) / 2;
constexpr int max_unknowns = 2 * max_terms;
constexpr double sampled_pixels = 40'000;
constexpr double even_contrast = 0.003;  // of the pixels: weight of a contrast that is even
constexpr double regular = 1e-9;         // of the pixels: keeps the equations solvable

constexpr int count_terms(int degree) { return (degree + 1) * (degree + 2) / 2; }

double centred(int i, int count) { return (2 * i + 1.0) / count - 1; }

void find_terms(double x, double y, int degree, double* out) {
  double* next = out;
  *next++ = 1;
  const double* before = out;
  for (int d = 1; d <= degree; before += d++) {
    for (int k = 0; k < d; ++k) *next++ = before[k] * x;
    *next++ = before[d - 1] * y;
  }
}

/// Normal equations of the unknowns, light before contrast.
class Equations {
 public:
  Equations(int light_terms, int contrast_terms)
      : light_terms_(light_terms), unknowns_(light_terms + contrast_terms) {}

  /// Adds a pixel; `terms` are those of the light, with room for those of the contrast.
  void add(double* terms, double set, double grey) {
    const int count = set != 0 ? unknowns_ : light_terms_;
    for (int i = light_terms_; i < count; ++i) terms[i] = terms[i - light_terms_] * set;
    for (int i = 0; i < count; ++i) {
      right_[i] += terms[i] * grey;
      for (int j = 0; j <= i; ++j) sums_[i][j] += terms[i] * terms[j];
    }
    ++pixels_;
  }

  std::vector<double> solved() {
    cv::Mat normal(unknowns_, unknowns_, CV_64F), solution;
    for (int i = 0; i < unknowns_; ++i)
      for (int j = 0; j <= i; ++j) normal.at<double>(i, j) = normal.at<double>(j, i) = sums_[i][j];
    for (int i = 0; i < unknowns_; ++i)
      normal.at<double>(i, i) += pixels_ * (i > light_terms_ ? even_contrast : regular);
    cv::solve(normal, cv::Mat(unknowns_, 1, CV_64F, right_), solution, cv::DECOMP_CHOLESKY);
    return {solution.begin<double>(), solution.end<double>()};
  }

 private:
  int light_terms_, unknowns_;
  double pixels_ = 0;
  double sums_[max_unknowns][max_unknowns] = {};
  double right_[max_unknowns] = {};
};

}  // namespace

cv::Mat LightPolynomial::over(cv::Size size) const {
  assert(degree <= max_degree && factors.size() == static_cast<std::size_t>(count_terms(degree)));
  cv::Mat out(size, CV_32F);
  for (int y = 0; y < size.height; ++y) {
    double of_x[max_degree + 1] = {};  // factors of the powers of x in this row
    const double v = centred(y, size.height);
    std::size_t i = 0;
    for (int d = 0; d <= degree; ++d) {
      double power = 1;
      for (int k = 0; k <= d; ++k, power *= v) of_x[d - k] += factors[i++] * power;
    }
    float* const row = out.ptr<float>(y);
    for (int x = 0; x < size.width; ++x) {
      const double u = centred(x, size.width);
      double sum = of_x[max_degree];
      for (int d = max_degree - 1; d >= 0; --d) sum = sum * u + of_x[d];
      row[x] = static_cast<float>(sum);
    }
  }
  return out;
}

LightFit fit_light(const cv::Mat& grey, const cv::Mat& set, const cv::Mat& view, int degree,
                   int contrast_degree) {
  assert(degree <= max_degree && contrast_degree <= degree);
  const int light_terms = count_terms(degree);
  const int contrast_terms = set.empty() ? 0 : count_terms(contrast_degree);
  Equations equations(light_terms, contrast_terms);
  const int step =
      std::max(1, cvRound(std::sqrt(static_cast<double>(grey.total()) / sampled_pixels)));
  double terms[max_unknowns];
  for (int y = 0; y < grey.rows; y += step)
    for (int x = 0; x < grey.cols; x += step) {
      if (!view.at<std::uint8_t>(y, x)) continue;
      find_terms(centred(x, grey.cols), centred(y, grey.rows), degree, terms);
      equations.add(terms, set.empty() ? 0 : set.at<float>(y, x), grey.at<float>(y, x));
    }
  const std::vector<double> solution = equations.solved();
  LightFit fit;
  fit.light = {degree, {solution.begin(), solution.begin() + light_terms}};
  if (contrast_terms > 0)
    fit.contrast = {contrast_degree, {solution.begin() + light_terms, solution.end()}};
  return fit;
}

}  // namespace microswarm::vision
