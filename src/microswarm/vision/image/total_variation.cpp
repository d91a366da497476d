// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/total_variation.hpp"

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "microswarm/core/execution/each_cpu.hpp"

namespace microswarm::vision {
namespace {

constexpr double largest_eigenvalue = 8;  // of the Laplacian of the pixel grid

/// u = f + weight · (div of the dual), in a row whose dual arrays have one zero before them.
MICROSWARM_EACH_CPU void primal_row(const float* f, const float* x, const float* y,
                                    const float* y_above, float weight, int count, float* u) {
  for (int i = 0; i < count; ++i) u[i] = f[i] + weight * (x[i] - x[i - 1] + y[i] - y_above[i]);
}

/// Rows of the dual of one pixel row, and of the point that runs ahead of it.
struct DualRow {
  float *px, *py, *qx, *qy;
};

/// A gradient step from q, projected on |p| <= 1; q runs ahead of the new p.
MICROSWARM_EACH_CPU void dual_row(const float* u, const float* u_below, float step, float ahead,
                                  int count, DualRow r) {
  for (int i = 0; i < count; ++i) {
    const float gx = r.qx[i] + step * (u[i + 1] - u[i]);
    const float gy = r.qy[i] + step * (u_below[i] - u[i]);
    const float squares = gx * gx + gy * gy;
    const float scale = 1.0F / std::sqrt(squares > 1.0F ? squares : 1.0F);
    const float x = gx * scale;
    const float y = gy * scale;
    r.qx[i] = x + ahead * (x - r.px[i]);
    r.qy[i] = y + ahead * (y - r.py[i]);
    r.px[i] = x;
    r.py[i] = y;
  }
}

}  // namespace

cv::Mat without_noise(const cv::Mat& picture, double weight, int steps, const Stop& stop) {
  assert(picture.type() == CV_32F);
  if (weight <= 0 || picture.empty()) return picture.clone();
  const int rows = picture.rows;
  const int columns = picture.cols;
  // Each dual row begins with a zero, for the divergence at the left border.
  cv::Mat dual[4];
  for (cv::Mat& d : dual) d = cv::Mat::zeros(rows, columns + 1, CV_32F);
  const auto row = [&](int y) {
    return DualRow{dual[0].ptr<float>(y) + 1, dual[1].ptr<float>(y) + 1, dual[2].ptr<float>(y) + 1,
                   dual[3].ptr<float>(y) + 1};
  };
  const std::vector<float> zeros(static_cast<std::size_t>(columns) + 1, 0.0F);
  std::vector<float> here(zeros), below(zeros);
  const auto primal = [&](int y, float* u) {
    const DualRow r = row(y);
    primal_row(picture.ptr<float>(y), r.qx, r.qy, y > 0 ? row(y - 1).qy : zeros.data(),
               static_cast<float>(weight), columns, u);
    u[columns] = u[columns - 1];  // no gradient across the border
  };
  const float step = static_cast<float>(1 / (largest_eigenvalue * weight));
  double t = 1;
  for (int k = 0; k < steps && !stop(); ++k) {
    const double next = (1 + std::sqrt(1 + 4 * t * t)) / 2;
    const float ahead = static_cast<float>((t - 1) / next);
    t = next;
    primal(0, here.data());
    for (int y = 0; y < rows; ++y) {
      if (y + 1 < rows) primal(y + 1, below.data());
      dual_row(here.data(), y + 1 < rows ? below.data() : here.data(), step, ahead, columns,
               row(y));
      std::swap(here, below);
    }
  }
  cv::Mat result(picture.size(), CV_32F);
  for (int y = 0; y < rows; ++y) {
    const DualRow r = row(y);
    primal_row(picture.ptr<float>(y), r.px, r.py, y > 0 ? row(y - 1).py : zeros.data(),
               static_cast<float>(weight), columns, result.ptr<float>(y));
  }
  return result;
}

}  // namespace microswarm::vision
