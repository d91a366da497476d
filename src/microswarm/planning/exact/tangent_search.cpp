// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/tangent_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"

namespace microswarm {
namespace {

constexpr std::uint8_t often = 8;  // queries that visit a circle before its hops are settled

/// Calls `take` with the wheels of a corner that a line may reach and this look has not seen yet.
template <class SidesOf, class Take>
void see(std::uint32_t corner, SidesOf&& sides_of, std::vector<std::uint32_t>& seen,
         std::uint32_t look, Take&& take) {
  std::uint32_t& left = seen[2 * corner];
  std::uint32_t& right = seen[2 * corner + 1];
  if (left == look && right == look) return;
  const Sides sides = sides_of();
  if (sides.left && std::exchange(left, look) != look) take(2 * corner);
  if (sides.right && std::exchange(right, look) != look) take(2 * corner + 1);
}

}  // namespace

TangentSearch::TangentSearch(const Map& map, double clearance)
    : map_(&map), corners_(&map.corners()), clearance_(clearance) {
  const Box& box = map.bounds();
  margin_ = std::max(1e-7 * clearance, 1e-10 * std::max(box.width(), box.height()));
  circles_.reserve(corners_->all().size());
  for (const Corner& corner : corners_->all()) circles_.push_back(circle_of(corner));
  wheels_.resize(2 * circles_.size());
  seen_.resize(2 * circles_.size(), 0);
  starts_seen_.resize(2 * circles_.size(), 0);
  bytes_ = circles_.size() * (sizeof(Circle) + 2 * sizeof(Wheel));
}

TangentSearch::Circle TangentSearch::circle_of(const Corner& corner) const {
  return {{.centre = corner.centre,
           .radius = corner.radius + clearance_ + margin_,
           .from = corner.from,
           .width = corner.width,
           .first = corner.first,
           .last = corner.last,
           .is_disc = corner.is_disc}};
}

/// Computes the tangents of a wheel.
void TangentSearch::know(std::uint32_t wheel) {
  const Circle& circle = circles_[wheel / 2];
  Wheel& at = wheels_[wheel];
  at.is_known = true;
  ++look_;
  corners_->seen_from(wheel / 2, circle.radius, clearance_, sense(wheel) > 0,
                      [&](std::uint32_t corner, auto&& sides) {
                        see(corner, sides, seen_, look_, [&](std::uint32_t to) {
                          if (corner != wheel / 2) add_hop(wheel, to);
                        });
                      });
  bytes_ += at.hops.capacity() * sizeof(Hop);
  std::ranges::sort(at.hops, [turn = sense(wheel)](const Hop& a, const Hop& b) {
    return a.leave != b.leave ? turn * a.leave < turn * b.leave : a.to < b.to;
  });
  if (circle.visits >= often) settle(wheel);
}

/// Adds the tangent of two wheels if it leaves from a free arc.
void TangentSearch::add_hop(std::uint32_t from, std::uint32_t to) {
  Circle& a = circles_[from / 2];
  const auto line = join(a, sense(from), circles_[to / 2], sense(to));
  if (!line) return;
  Hop hop{.line = *line, .to = to};
  hop.leave = a.angle_of(-sense(from) * perpendicular(line->along));
  const int arc = still_arc_at(a, hop.leave);
  if (arc < 0) return;
  hop.leave_arc = static_cast<std::uint16_t>(arc);
  wheels_[from].hops.push_back(hop);
}

/// Whether a hop is free of walls.
bool TangentSearch::test(std::uint32_t from, Hop& hop) {
  if (hop.walls != Walls::unknown) return hop.walls == Walls::free;
  hop.walls = Walls::blocked;
  Circle& there = circles_[hop.to / 2];
  hop.arrive = there.angle_of(-sense(hop.to) * perpendicular(hop.line.along));
  const int arc = still_arc_at(there, hop.arrive);
  if (arc < 0) return false;
  hop.arrive_arc = static_cast<std::uint16_t>(arc);
  if (map_->is_free(segment(touch(from, hop.line), hop.line), clearance_)) hop.walls = Walls::free;
  return hop.walls == Walls::free;
}

/// Tests all hops of a wheel and forgets the blocked ones.
void TangentSearch::settle(std::uint32_t wheel) {
  std::erase_if(wheels_[wheel].hops, [&](Hop& hop) { return !test(wheel, hop); });
}

/// Index of the arc free of walls that contains this angle; −1 if none does.
int TangentSearch::still_arc_at(Circle& circle, double at) {
  if (!circle.is_cut) {
    circle.is_cut = true;
    circle.arcs = cut(circle, nullptr, arcs_);
  }
  return microswarm::arc_at(circle, at, circle.arcs.of(arcs_));
}

/// The same for arcs that are free of moving bodies too.
int TangentSearch::arc_at(Circle& circle, double at) {
  return is_near_moving(circle) ? microswarm::arc_at(circle, at, circle.arcs_now.of(arcs_now_))
                                : still_arc_at(circle, at);
}

TangentSearch::ArcRange TangentSearch::cut(const Circle& circle, const BodySet* moving,
                                           std::vector<Arc>& arcs) const {
  const std::size_t first = arcs.size();
  add_free_arcs(circle, *map_, moving, clearance_, margin_, arcs);
  return {static_cast<std::uint32_t>(first), static_cast<std::uint16_t>(arcs.size() - first)};
}

/// Whether a moving body may cut the circle; if so, computes its current arcs.
bool TangentSearch::is_near_moving(Circle& circle) {
  if (!moving_) return false;
  if (circle.query != query_) {
    circle.query = query_;
    circle.is_near = !moving_->is_free(circle.centre, circle.radius + clearance_ + 2 * margin_);
    if (circle.is_near) circle.arcs_now = cut(circle, moving_, arcs_now_);
  }
  return circle.is_near;
}

TangentSearch::Wheel& TangentSearch::wheel(std::uint32_t number) {
  Wheel& at = wheels_[number];
  if (at.query != query_) {
    at.query = query_;
    at.first_label = none;
  }
  return at;
}

void TangentSearch::push(const Open& open) {
  open_.push_back(open);
  std::push_heap(open_.begin(), open_.end());
}

void TangentSearch::begin(Vec2 start, Vec2 goal, const BodySet& moving) {
  start_ = start;
  goal_ = goal;
  ends_there_ = true;
  moving_ = moving.empty() ? nullptr : &moving;
  ++query_;
  arcs_now_.clear();
  guesses_.clear();
  labels_.clear();
  open_.clear();
  moving_corners_.clear();
  for (const Body& body : moving.bodies()) add_corners(body, map_->bounds(), moving_corners_);
  circles_.resize(still_count());
  for (const Corner& corner : moving_corners_) circles_.push_back(circle_of(corner));
  wheels_.resize(2 * circles_.size());
}

void TangentSearch::open_from_start() {
  from_start_.begin(corners_->cells(), start_, goal_, clearance_);
  for (std::uint32_t to = 2 * still_count(); to < wheels_.size(); ++to) open_from_start(to);
  look_from_start(distance(start_, goal_));
}

void TangentSearch::begin_to_everywhere(Vec2 start) {
  begin(start, start, {});
  ends_there_ = false;
  open_from_start();
  look_from_start(infinity);
}

void TangentSearch::head_for(Vec2 position) {
  goal_ = position;
  for (Open& open : open_) {
    const TangentLine& line = open.is_guess
                                  ? guesses_[open.line].line
                                  : wheels_[labels_[open.parent].wheel].hops[open.line].line;
    open.estimate = open.length + distance(touch(open.to, line), position);
  }
  std::make_heap(open_.begin(), open_.end());
}

/// Opens the lines from the start that a path of slightly more than this length may use.
void TangentSearch::look_from_start(double length) {
  constexpr double more = 1.05;
  corners_->look_on(from_start_, more * length, [&](std::uint32_t corner, auto&& sides) {
    see(corner, sides, starts_seen_, query_, [&](std::uint32_t to) { open_from_start(to); });
  });
}

void TangentSearch::open_from_start(std::uint32_t to) {
  const auto line = join({.centre = start_}, 1, circles_[to / 2], sense(to));
  if (!line) return;
  const double left = distance(touch(to, *line), goal_);
  const auto number = static_cast<std::uint32_t>(guesses_.size());
  guesses_.push_back({.line = *line, .to = to});
  push({line->length + left, line->length, none, to, number, true});
}

/// Whether an earlier label at the wheel reaches this one's arrival with no greater length.
bool TangentSearch::is_dominated(const Label& label) {
  const Circle& circle = circles_[label.wheel / 2];
  const double to = sense(label.wheel);
  for (std::uint32_t i = wheel(label.wheel).first_label; i != none; i = labels_[i].next) {
    const Label& other = labels_[i];
    if (other.arc != label.arc) continue;
    const double angle = circle.angle_around(to, other.arrive, label.arrive);
    if (angle >= 0 && (!circle.is_disc || angle < pi) &&
        other.length + circle.radius * angle <= label.length)
      return true;
  }
  return false;
}

/// Opens the lines that leave the wheel ahead of the label's arrival.
void TangentSearch::expand(std::uint32_t number) {
  const Label label = labels_[number];
  const std::uint32_t corner = label.wheel / 2;
  if (ends_there_) guess(label, number, {.centre = goal_}, none);
  if (corner < still_count()) {
    expand_hops(label, number);
    for (std::uint32_t i = still_count(); i < circles_.size(); ++i) guess_both(label, number, i);
    return;
  }
  for (std::uint32_t i = 0; i < circles_.size(); ++i)
    if (i != corner) guess_both(label, number, i);
}

/// Opens the kept hops.
void TangentSearch::expand_hops(const Label& label, std::uint32_t number) {
  Circle& circle = circles_[label.wheel / 2];
  if (!wheels_[label.wheel].is_known) know(label.wheel);
  const bool is_first =  // visit of this circle in this query: none of its hops is open
      label.next == none && wheel(label.wheel ^ 1).first_label == none;
  if (is_first && circle.visits < often && ++circle.visits == often)
    for (const std::uint32_t either : {label.wheel, label.wheel ^ 1}) settle(either);
  const bool is_near = is_near_moving(circle);
  const double turn = sense(label.wheel);
  std::vector<Hop>& hops = wheels_[label.wheel].hops;
  const auto consider = [&](std::size_t i) {
    Hop& hop = hops[i];
    if (hop.walls == Walls::blocked) return;
    const int arc = is_near ? arc_at(circle, hop.leave) : hop.leave_arc;
    if (arc != label.arc) return;
    const double angle = circle.angle_around(turn, label.arrive, hop.leave);
    const double length = label.length + circle.radius * angle + hop.line.length;
    if (hop.query == query_ && hop.best <= length) return;
    hop.query = query_;
    hop.best = length;
    const double left = distance(touch(hop.to, hop.line), goal_);
    push({length + left, length, number, hop.to, static_cast<std::uint32_t>(i), false});
  };
  const auto ahead = std::ranges::partition_point(
      hops, [&](const Hop& hop) { return turn * hop.leave < turn * label.arrive - angle_slack; });
  const auto first = static_cast<std::size_t>(ahead - hops.begin());
  for (std::size_t i = first; i < hops.size(); ++i) consider(i);
  if (circle.is_disc)  // a full turn
    for (std::size_t i = 0; i < first; ++i) consider(i);
}

void TangentSearch::guess_both(const Label& label, std::uint32_t number, std::uint32_t corner) {
  for (std::uint32_t to = 2 * corner; to < 2 * corner + 2; ++to)
    guess(label, number, circles_[corner], to);
}

std::optional<TangentSearch::Leaving> TangentSearch::leaving(const Label& label,
                                                             const TurningCircle& there,
                                                             double sense_there) {
  Circle& circle = circles_[label.wheel / 2];
  const double turn = sense(label.wheel);
  const auto line = join(circle, turn, there, sense_there);
  if (!line) return std::nullopt;
  const double leave = circle.angle_of(-turn * perpendicular(line->along));
  const double angle = circle.angle_around(turn, label.arrive, leave);
  if (angle < 0 || arc_at(circle, leave) != label.arc) return std::nullopt;
  return Leaving{*line, leave, label.length + circle.radius * angle + line->length};
}

/// Opens the tangent from the label's wheel to another, or to the goal.
void TangentSearch::guess(const Label& label, std::uint32_t number, const TurningCircle& there,
                          std::uint32_t to) {
  const bool ends = to == none;
  const auto line = leaving(label, there, ends ? 1 : sense(to));
  if (!line) return;
  const double left = ends ? 0 : distance(touch(to, line->line), goal_);
  push({line->length + left, line->length, number, to, static_cast<std::uint32_t>(guesses_.size()),
        true});
  guesses_.push_back({line->line, line->leave, to});
}

double TangentSearch::reached() const {
  const double next = open_.empty() ? infinity : open_.front().estimate;
  return std::min(next, from_start_.left());
}

std::optional<std::uint32_t> TangentSearch::next(double most) {
  while (reached() <= most && reached() < infinity) {
    if (from_start_.left() <= reached()) {
      look_from_start(from_start_.left());
      continue;
    }
    std::pop_heap(open_.begin(), open_.end());
    const Open open = open_.back();
    open_.pop_back();
    Label label{.length = open.length, .parent = open.parent};
    if (!take(open, label)) continue;
    const auto number = static_cast<std::uint32_t>(labels_.size());
    if (label.wheel != none) {
      if (is_dominated(label)) continue;
      label.next = std::exchange(wheel(label.wheel).first_label, number);
    }
    labels_.push_back(label);
    return number;
  }
  return std::nullopt;
}

/// Makes the label of an open line; false if the line is not free or a better one was found.
bool TangentSearch::take(const Open& open, Label& label) {
  const std::uint32_t leaves = open.parent == none ? none : labels_[open.parent].wheel;
  if (!open.is_guess) {
    Hop& hop = wheels_[leaves].hops[open.line];
    if (hop.best < open.length || !test(leaves, hop)) return false;
    label.line = hop.line;
    label.from = touch(leaves, hop.line);
    label.leave = hop.leave;
    label.arrive = hop.arrive;
    label.wheel = hop.to;
    label.arc = hop.arrive_arc;
    if (!moving_) return true;
    if (is_near_moving(circles_[hop.to / 2]) && !arrive(label)) return false;
    return moving_->is_free(segment(label.from, label.line), clearance_);
  }
  const Guess& guess = guesses_[open.line];
  label.line = guess.line;
  label.leave = guess.leave;
  label.from = leaves == none ? start_ : touch(leaves, guess.line);
  label.wheel = guess.to;
  if (guess.to != none) {
    label.arrive =
        circles_[guess.to / 2].angle_of(-sense(guess.to) * perpendicular(guess.line.along));
    if (!arrive(label)) return false;
  }
  return is_free(segment(label.from, label.line));
}

/// Finds the arc at which a label arrives; false if it is not free.
bool TangentSearch::arrive(Label& label) {
  const int arc = arc_at(circles_[label.wheel / 2], label.arrive);
  label.arc = static_cast<std::uint16_t>(std::max(0, arc));
  return arc >= 0;
}

bool TangentSearch::is_free(Segment s) const {
  return map_->is_free(s, clearance_) && (!moving_ || moving_->is_free(s, clearance_));
}

std::vector<Vec2> TangentSearch::path_to(std::uint32_t label) const {
  std::vector<std::uint32_t> chain;
  for (std::uint32_t i = label; i != none; i = labels_[i].parent) chain.push_back(i);
  std::ranges::reverse(chain);
  std::vector<Vec2> path{start_};
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Label& next = labels_[chain[k]];
    if (k == 0)
      add(next.end(), path);
    else
      go_on(labels_[chain[k - 1]], {next.line, next.leave}, next.end(), path);
  }
  return path;
}

void TangentSearch::go_on(const Label& label, const Leaving& leaving, Vec2 position,
                          std::vector<Vec2>& path) const {
  draw_arc(circles_[label.wheel / 2], sense(label.wheel), label.arrive, leaving.leave, path);
  add(touch(label.wheel, leaving.line), path);
  add(position, path);
}

void TangentSearch::add(Vec2 p, std::vector<Vec2>& path) const {
  if (distance(p, path.back()) > 0.01 * margin_) path.push_back(p);
}

/// Adds tangent lines around the arc.
void TangentSearch::draw_arc(const Circle& circle, double sense, double from, double to,
                             std::vector<Vec2>& points) const {
  const double angle = circle.angle_around(sense, from, to);
  constexpr double step = 0.1;  // [rad]
  const int count = static_cast<int>(std::ceil(angle / step));
  if (angle < angle_slack) return;
  const double each = angle / count;
  const double outer = circle.radius / maths::cos(0.5 * each);
  for (int i = 0; i < count; ++i)
    add(circle.centre + outer * unit_vector(circle.from + from + sense * (i + 0.5) * each), points);
}

}  // namespace microswarm
