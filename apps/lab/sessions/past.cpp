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
  std::size_t bytes = sizeof(Diagnostics);  // a tree is kept once
  if (const auto* radar = std::get_if<RadarDiagnostics>(&shown)) bytes += bytes_in(radar->beams);
  if (const auto* ahead = std::get_if<PredictiveDiagnostics>(&shown))
    bytes += bytes_in(ahead->bodies) + bytes_in(ahead->corners);
  return bytes;
}

template <class Shown>
bool has_tree(const Shown& shown) {
  if constexpr (requires { shown.nodes; }) return !shown.nodes.empty();
  return false;
}

template <class T>
void drop_every_second(std::vector<T>& list, auto&& stays) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (i % 2 == 0 || stays(list[i])) {
      if (kept != i) list[kept] = std::move(list[i]);
      ++kept;
    }
  list.resize(kept);
}

}  // namespace

void Past::add(const experiment::Tick& tick, const experiment::Metrics& metrics, bool is_recorded) {
  if (ticks_ % metrics_period_ == 0) {
    if (metrics_.size() == max_metrics) {
      drop_every_second(metrics_, [](const auto&) { return false; });
      metrics_period_ *= 2;
    }
    if (ticks_ % metrics_period_ == 0) metrics_.push_back(metrics);
  }
  const bool is_due = !is_recorded && !tick.end && ticks_ % period_ == 0;
  ++ticks_;
  if (!is_due) return;
  const Diagnostics& shown = tick.diagnostics.value();
  bytes_ += bytes_of(shown);
  log_.add(tick.frame.t, shown);
  if (bytes_ > max_bytes_) halve();
}

void Past::halve() {
  experiment::DiagnosticsLog::fields(log_, [](auto& rows, const FieldInfo&) {
    drop_every_second(rows, [](const auto& row) { return has_tree(row.shown); });
  });
  bytes_ /= 2;
  period_ *= 2;
}

std::optional<experiment::Metrics> Past::metrics(std::uint64_t frame) const {
  if (metrics_.empty()) return std::nullopt;
  return metrics_[std::min<std::uint64_t>(frame / metrics_period_, metrics_.size() - 1)];
}

}  // namespace microswarm::lab
