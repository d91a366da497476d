// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/shortest_path_tree.hpp"

#include <algorithm>
#include <utility>

namespace microswarm::planning {

ShortestPathTree::ShortestPathTree(const Map& map, Vec2 goal, double clearance, Growth growth)
    : map_(&map),
      goal_(goal),
      clearance_(clearance),
      growth_(growth),
      has_root_(is_finite(goal) && map.is_free(goal, clearance)) {}

double ShortestPathTree::length_from(Vec2 p) { return best_from(p).length; }

std::vector<Vec2> ShortestPathTree::path_from(Vec2 p) {
  const Best best = best_from(p);
  if (best.length == infinity) return {};
  if (best.label == TangentQuery::none) return {p, goal_};
  std::vector<Vec2> path = search_->path_to(best.label);
  search_->go_on(search_->labels()[best.label], best.line, p, path);
  path.back() = p;
  std::ranges::reverse(path);
  return path;
}

/// Looks around `p` as far as a path of the length found so far may bend, then grows the tree
/// until no shorter path can follow.
ShortestPathTree::Best ShortestPathTree::best_from(Vec2 p) {
  was_stopped_ = false;
  if (!has_root_ || !is_finite(p) || !map_->is_free(p, clearance_)) return {};
  const double straight = distance(p, goal_);
  if (map_->is_free(Segment{p, goal_}, clearance_)) return {.length = straight};
  if (!search_) begin();
  seen_.clear();
  ++query_;
  look_.begin(graph_->corners().cells(), p, goal_, clearance_);
  look_on(straight);
  Best best = best_over_seen(p);
  if (best.length > look_.left()) {
    look_on(best.length);
    best = best_over_seen(p);
  }
  constexpr double near = 0.02;
  if (growth_ == Growth::towards_queries && distance(p, headed_for_) > near * straight &&
      search_->reached() - distance(p, headed_for_) < best.length) {
    if (graph_->bytes() + search_->bytes() > max_bytes_) {
      begin();
      best = {};
      for (const std::uint32_t wheel : seen_) seen_in_[wheel] = query_;
    }
    search_->head_for(headed_for_ = p);
  }
  const double off = distance(p, headed_for_);
  for (int expanded = 0; search_->reached() - off < best.length; ++expanded) {
    if (expanded % 8 == 0 && (was_stopped_ = stop_())) break;
    const auto number = search_->next(best.length + off);
    if (!number) break;
    search_->expand(*number);
    const TangentQuery::Label& label = search_->labels()[*number];
    if (seen_in_[label.wheel] != query_) continue;
    const auto line = search_->leaving(label, p);
    if (line && line->length < best.length && is_free(*line, p))
      best = {line->length, *number, *line};
  }
  return best;
}

void ShortestPathTree::begin() {
  search_.reset();
  graph_ = std::make_unique<TangentGraph>(*map_, clearance_);
  search_.emplace(*graph_, goal_);
  headed_for_ = goal_;
  seen_in_.assign(2 * graph_->corners().all().size(), 0);
}

bool ShortestPathTree::is_free(const TangentQuery::Leaving& leaving, Vec2 p) const {
  return map_->is_free(Segment{p - leaving.line.length * leaving.line.along, p}, clearance_);
}

/// Marks the wheels that a path of at most this length may touch as seen.
void ShortestPathTree::look_on(double length) {
  const auto see = [this](std::uint32_t wheel) {
    if (std::exchange(seen_in_[wheel], query_) != query_) seen_.push_back(wheel);
  };
  graph_->corners().look_on(look_, length, [&](std::uint32_t corner, auto&& find_sides) {
    const Sides sides = find_sides();
    if (sides.left) see(2 * corner + 1);
    if (sides.right) see(2 * corner);
  });
}

/// Shortest path over the wheels seen and the tree grown so far. A line is computed when its lower
/// bound is the minimum, and tested when its length is.
ShortestPathTree::Best ShortestPathTree::best_over_seen(Vec2 p) {
  constexpr double rounding = 1e-9;
  lines_.clear();
  const auto labels = search_->labels();
  for (const std::uint32_t wheel : seen_) {
    std::uint32_t i = search_->last_label(wheel);
    if (i == TangentQuery::none) continue;
    const double straight = (1 - rounding) * search_->distance_to(wheel, p);
    for (; i != TangentQuery::none; i = labels[i].next)
      lines_.push_back({.length = (1 - rounding) * labels[i].length + straight, .label = i});
  }
  const auto later = [](const Line& a, const Line& b) {
    if (a.length != b.length) return a.length > b.length;
    return a.is_known != b.is_known ? a.is_known : a.label > b.label;
  };
  std::ranges::make_heap(lines_, later);
  while (!lines_.empty()) {
    std::ranges::pop_heap(lines_, later);
    Line next = lines_.back();
    lines_.pop_back();
    if (!next.is_known) {
      const auto line = search_->leaving(labels[next.label], p);
      if (!line) continue;
      lines_.push_back({line->length, next.label, true, *line});
      std::ranges::push_heap(lines_, later);
    } else if (is_free(next.line, p)) {
      return {next.length, next.label, next.line};
    }
  }
  return {};
}

}  // namespace microswarm::planning
