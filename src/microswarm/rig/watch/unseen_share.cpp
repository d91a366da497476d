// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/unseen_share.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace microswarm::rig {
namespace {

constexpr std::size_t enough = 10;  // pictures
constexpr double noted_share = 0.1;

}  // namespace

void UnseenShare::take(bool is_seen, double t) {
  window_.push_back({t, is_seen});
  ++pictures_;
  unseen_ += !is_seen;
  unseen_in_window_ += !is_seen;
  while (t - window_.front().t > length_) {
    unseen_in_window_ -= !window_.front().is_seen;
    window_.pop_front();
  }
  if (window_.size() < enough || t - window_.front().t < 0.5 * length_) return;
  highest_ = std::max(highest_, share());
  if (max_share_ <= 0 || share() <= max_share_ || !fault_.empty()) return;
  fault_ = fmt::format("the swarm was not found in {} of the last {} pictures, allowed {:.0f} %",
                       unseen_in_window_, window_.size(), 100 * max_share_);
}

double UnseenShare::share() const {
  return window_.empty()
             ? 0
             : static_cast<double>(unseen_in_window_) / static_cast<double>(window_.size());
}

std::string UnseenShare::take_note() {
  if (told_ || highest_ <= noted_share) return {};
  told_ = true;
  return fmt::format("the swarm was not found in {} of {} pictures so far", unseen_, pictures_);
}

}  // namespace microswarm::rig
