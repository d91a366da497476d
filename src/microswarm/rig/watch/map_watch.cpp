// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/map_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace microswarm::rig {
namespace {

constexpr int looks_beyond = 2;
constexpr int looks_unsure = 3;
constexpr double clear_share = 0.7;  // of the edges, seen at the start, whose loss is a fault

}  // namespace

void MapWatch::take(const PictureFit& fit) {
  const bool is_sure = fit.unsure.empty();
  if (!first_share_) first_share_ = is_sure ? fit.seen_share : 0;
  shift_ = is_sure ? std::optional(fit.shift_px) : std::nullopt;
  unsure_ = is_sure ? 0 : unsure_ + 1;
  const bool is_beyond = is_sure && max_shift_ > 0 && fit.shift_px > max_shift_;
  beyond_ = is_beyond ? beyond_ + 1 : 0;
  if (is_sure) largest_ = std::max(largest_, fit.shift_px);
  if (is_sure && max_shift_ > 0 && !is_beyond && fit.shift_px > 0.6 * max_shift_ &&
      !std::exchange(told_shift_, true))
    notes_.push_back(fit_text(fit));
  if (!is_sure && unsure_ == looks_unsure && !std::exchange(told_unsure_, true))
    notes_.push_back("it is no longer known whether the map lies over the picture: " + fit.unsure);
  if (!fault_.empty() || max_shift_ <= 0) return;
  if (beyond_ >= looks_beyond)
    fault_ = fmt::format("{}; allowed {:.6g} px", fit_text(fit), max_shift_);
  else if (unsure_ >= looks_unsure && *first_share_ >= clear_share)
    fault_ = "what the map shows is no longer found in the picture: " + fit.unsure;
}

std::string MapWatch::take_note() {
  if (notes_.empty()) return {};
  std::string note = std::move(notes_.front());
  notes_.pop_front();
  return note;
}

}  // namespace microswarm::rig
