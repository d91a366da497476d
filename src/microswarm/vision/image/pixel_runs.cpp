// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/pixel_runs.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace microswarm::vision {
namespace {

/// The first pixel from `x` on that is set; `width` if there is none.
int next_set(const std::uint8_t* row, int x, int width) {
  for (std::uint64_t word = 0; x + 8 <= width; x += 8) {
    std::memcpy(&word, row + x, sizeof word);
    if (word != 0) break;
  }
  while (x < width && row[x] == 0) ++x;
  return x;
}

std::vector<PixelRun> list_runs(const cv::Mat& set) {
  std::vector<PixelRun> runs;
  for (int y = 0; y < set.rows; ++y) {
    const auto* row = set.ptr<std::uint8_t>(y);
    for (int x = next_set(row, 0, set.cols); x < set.cols;) {
      const int begin = x;
      while (x < set.cols && row[x] != 0) ++x;
      runs.push_back({y, begin, x});
      x = next_set(row, x, set.cols);
    }
  }
  return runs;
}

/// The first run of each run's piece, found by following `parent`.
std::size_t find_root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Joins runs that share an edge; the earlier one is the root.
std::vector<std::size_t> find_roots(const std::vector<PixelRun>& runs) {
  std::vector<std::size_t> parent(runs.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  std::size_t above = 0;  // the first run of the row before that may touch
  for (std::size_t i = 0; i < runs.size(); ++i) {
    while (runs[above].row < runs[i].row - 1) ++above;
    while (runs[above].row == runs[i].row - 1 && runs[above].end <= runs[i].begin) ++above;
    for (std::size_t k = above; runs[k].row == runs[i].row - 1 && runs[k].begin < runs[i].end;
         ++k) {
      const std::size_t a = find_root(parent, k);
      const std::size_t b = find_root(parent, i);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = find_root(parent, i);
  return parent;
}

}  // namespace

std::vector<RunPiece> connected_runs(const cv::Mat& set) {
  const std::vector<PixelRun> runs = list_runs(set);
  const std::vector<std::size_t> root = find_roots(runs);
  std::vector<std::size_t> run_pieces(runs.size());
  std::vector<RunPiece> pieces;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PixelRun& run = runs[i];
    if (root[i] == i) {
      run_pieces[i] = pieces.size();
      pieces.push_back({{}, {run.begin, run.row, 0, 0}, 0});
    }
    RunPiece& piece = pieces[run_pieces[root[i]]];
    const int left = std::min(piece.box.x, run.begin);
    piece.box.width = std::max(piece.box.br().x, run.end) - left;
    piece.box.x = left;
    piece.box.height = run.row + 1 - piece.box.y;
    piece.area += run.end - run.begin;
    piece.runs.push_back(run);
  }
  return pieces;
}

}  // namespace microswarm::vision
