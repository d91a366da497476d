// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/shortest_path_tree.hpp"

#include <algorithm>

namespace microswarm {

ShortestPathTree::ShortestPathTree(const Map& map, Vec2 goal, double clearance)
    : map_(&map),
      goal_(goal),
      clearance_(clearance),
      has_root_(is_finite(goal) && map.is_free(goal, clearance)) {}

double ShortestPathTree::length_from(Vec2 p) { return best_from(p).length; }

std::vector<Vec2> ShortestPathTree::path_from(Vec2 p) {
  const Best best = best_from(p);
  if (best.length == infinity) return {};
  if (best.label == TangentSearch::none) return {p, goal_};
  std::vector<Vec2> path = search_->path_to(best.label);
  search_->go_on(search_->labels()[best.label], best.line, p, path);
  path.back() = p;
  std::ranges::reverse(path);
  return path;
}

/// The tree is grown and the look widened until nothing shorter can come.
ShortestPathTree::Best ShortestPathTree::best_from(Vec2 p) {
  if (!has_root_ || !is_finite(p) || !map_->is_free(p, clearance_)) return {};
  if (map_->is_free(Segment{p, goal_}, clearance_)) return {.length = distance(p, goal_)};
  const double straight = distance(p, goal_);
  if (!search_) {
    search_.emplace(*map_, clearance_);
    search_->begin_to_everywhere(goal_);
    headed_for_ = goal_;
  }
  turn_to(p, straight);
  const double off = distance(p, headed_for_);
  seen_.clear();
  look_.begin(search_->corners().cells(), p, goal_, clearance_);
  constexpr double more = 1.5;
  for (double length = straight;;) {
    grow(length + off);
    look_on(length);
    const Best best = best_over_seen(p);
    const double known = std::min(search_->reached() - off, look_.left());
    if (best.length <= std::max(length, known) || known == infinity) return best;
    length = best.length < infinity ? best.length : std::max(more * length, known);
  }
}

/// Heads for `p` unless that is nearly so. A tree that was asked for places all over heads for its
/// root, and so grows about evenly.
void ShortestPathTree::turn_to(Vec2 p, double straight) {
  constexpr double near = 0.1;
  constexpr int most_turns = 64;
  if (turns_ == most_turns || distance(p, headed_for_) <= near * straight) return;
  ++turns_;
  headed_for_ = turns_ == most_turns ? goal_ : p;
  search_->head_for(headed_for_);
}

void ShortestPathTree::grow(double length) {
  while (const auto label = search_->next(length)) search_->expand(*label);
}

/// Sees the wheels over which ways of this length may lead, as the tree goes around them.
void ShortestPathTree::look_on(double length) {
  search_->corners().look_on(look_, length, [&](std::uint32_t corner, auto&& sides_of) {
    const Sides sides = sides_of();
    if (sides.left) seen_.push_back(2 * corner + 1);
    if (sides.right) seen_.push_back(2 * corner);
  });
  std::ranges::sort(seen_);
  seen_.erase(std::unique(seen_.begin(), seen_.end()), seen_.end());
}

/// The shortest path over what is seen and grown so far. A line is computed when its lower bound
/// comes first, and tested when its length does.
ShortestPathTree::Best ShortestPathTree::best_over_seen(Vec2 p) {
  constexpr double rounding = 1e-9;
  lines_.clear();
  const auto labels = search_->labels();
  for (const std::uint32_t wheel : seen_) {
    std::uint32_t i = search_->last_label(wheel);
    if (i == TangentSearch::none) continue;
    const double straight = (1 - rounding) * search_->distance_to(wheel, p);
    for (; i != TangentSearch::none; i = labels[i].next)
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
    } else if (const TangentLine& line = next.line.line;
               map_->is_free(Segment{p - line.length * line.along, p}, clearance_)) {
      return {next.length, next.label, next.line};
    }
  }
  return {};
}

}  // namespace microswarm
