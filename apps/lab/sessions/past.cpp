// SPDX-License-Identifier: Apache-2.0
#include "lab/sessions/past.hpp"

#include <algorithm>
#include <variant>

namespace microswarm::lab {
namespace {

template <class T>
std::size_t bytes_in(const std::vector<T>& list) {
  return list.size() * sizeof(T);
}

std::size_t bytes_of(const Diagnostics& shown) {
  std::size_t bytes = sizeof(Diagnostics);
  if (const auto* radar = std::get_if<RadarDiagnostics>(&shown)) bytes += bytes_in(radar->beams);
  if (const auto* ahead = std::get_if<PredictiveDiagnostics>(&shown))
    bytes += bytes_in(ahead->bodies) + bytes_in(ahead->corners);
  return bytes;
}

}  // namespace

void Past::add(const experiment::Tick& tick, const experiment::Metrics& metrics, bool is_recorded) {
  if (ticks_ % metrics_period_ == 0) {
    if (metrics_.size() == max_metrics) {
      std::size_t number = 0;
      std::erase_if(metrics_, [&](const auto&) { return number++ % 2 != 0; });
      metrics_period_ *= 2;
    }
    if (ticks_ % metrics_period_ == 0) metrics_.push_back(metrics);
  }
  const bool is_due = !is_recorded && !tick.end && ticks_ % period_ == 0;
  ++ticks_;
  if (!is_due) return;
  Diagnostics shown = tick.diagnostics.value();
  bytes_ += bytes_of(shown);
  if (auto* plan = std::get_if<AggregationDiagnostics>(&shown)) keep_tree(*plan);
  log_.add(tick.frame.t, std::move(shown));
  if (bytes_ > max_bytes_) halve();
}

/// Leaves a tree out that is the newest one, without a search through all rows.
void Past::keep_tree(AggregationDiagnostics& plan) {
  if (plan.nodes == tree_.nodes && plan.regions == tree_.regions) {
    plan.nodes.clear();
    plan.regions.clear();
  } else {
    tree_ = {.nodes = plan.nodes, .regions = plan.regions};
    tree_bytes_ += bytes_in(plan.nodes) + bytes_in(plan.regions);
  }
}

void Past::halve() {
  log_.thin();
  bytes_ /= 2;
  period_ *= 2;
}

std::optional<experiment::Metrics> Past::metrics(std::uint64_t frame) const {
  if (metrics_.empty()) return std::nullopt;
  return metrics_[std::min<std::uint64_t>(frame / metrics_period_, metrics_.size() - 1)];
}

}  // namespace microswarm::lab
