// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/tangent_query.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::planning {

TangentQuery::TangentQuery(TangentGraph& graph, Vec2 start, Vec2 goal, bool ends_there,
                           const BodySet* moving, Memory memory)
    : graph_(&graph),
      query_(graph.begin_query(moving)),
      start_(start),
      goal_(goal),
      ends_there_(ends_there),
      moving_(moving),
      from_start_(std::move(memory.from_start)),
      circles_now_(std::move(memory.circles_now)),
      arcs_now_(std::move(memory.arcs_now)),
      guesses_(std::move(memory.guesses)),
      labels_(std::move(memory.labels)),
      open_(std::move(memory.open)) {
  circles_now_.assign(moving ? graph.circle_count() : 0, {});
  arcs_now_.clear();
  guesses_.clear();
  labels_.clear();
  open_.clear();
  from_start_.begin(graph.corners().cells(), start_, goal_, graph.clearance());
  for (std::uint32_t to = 2 * graph.still_count(); to < 2 * graph.circle_count(); ++to)
    open_from_start(to);
  look_from_start(distance(start_, goal_));
}

TangentQuery::TangentQuery(TangentGraph& graph, Vec2 start, Vec2 goal, const BodySet& moving,
                           Memory memory)
    : TangentQuery(graph, start, goal, true, moving.empty() ? nullptr : &moving,
                   std::move(memory)) {}

TangentQuery::TangentQuery(TangentGraph& graph, Vec2 start)
    : TangentQuery(graph, start, start, false, nullptr, {}) {
  look_from_start(infinity);
}

TangentQuery::Memory TangentQuery::release() {
  return {std::move(from_start_), std::move(circles_now_), std::move(arcs_now_),
          std::move(guesses_),    std::move(labels_),      std::move(open_)};
}

/// Index of the free arc that contains this angle; −1 if none does.
int TangentQuery::arc_at(std::uint32_t circle, double angle) {
  if (!is_near_moving(circle)) return graph_->arc_at(circle, angle);
  return microswarm::planning::arc_at(graph_->circle(circle), angle,
                                      circles_now_[circle].arcs.of(arcs_now_));
}

/// Whether a moving body may cut the circle; if so, computes its current arcs.
bool TangentQuery::is_near_moving(std::uint32_t circle) {
  if (!moving_) return false;
  CircleNow& now = circles_now_[circle];
  if (!std::exchange(now.is_known, true)) {
    const TurningCircle& at = graph_->circle(circle);
    now.is_near =
        !moving_->is_free(at.centre, at.radius + graph_->clearance() + 2 * graph_->margin());
    if (now.is_near) now.arcs = graph_->cut(circle, moving_, arcs_now_);
  }
  return now.is_near;
}

void TangentQuery::push(const Open& open) {
  open_.push_back(open);
  std::push_heap(open_.begin(), open_.end());
}

void TangentQuery::head_for(Vec2 position) {
  goal_ = position;
  for (Open& open : open_) {
    const TangentLine& line = open.is_guess
                                  ? guesses_[open.line].line
                                  : graph_->hop(labels_[open.parent].wheel, open.line).line;
    open.estimate = open.length + distance(graph_->touch(open.to, line), position);
  }
  std::make_heap(open_.begin(), open_.end());
}

/// Opens the lines from the start that a path of slightly more than this length may use.
void TangentQuery::look_from_start(double length) {
  constexpr double more = 1.05;
  graph_->corners().look_on(from_start_, more * length, [&](std::uint32_t corner, auto&& sides) {
    take_unseen(
        corner, sides,
        [this](std::uint32_t wheel) -> std::uint32_t& { return graph_->marks()[wheel].opened; },
        query_, [&](std::uint32_t to) { open_from_start(to); });
  });
}

void TangentQuery::open_from_start(std::uint32_t to) {
  const auto line =
      graph_->join({.centre = start_}, 1, graph_->wheel_circle(to), TangentGraph::sense(to));
  if (!line) return;
  const double left = distance(graph_->touch(to, *line), goal_);
  const auto number = static_cast<std::uint32_t>(guesses_.size());
  guesses_.push_back({.line = *line, .to = to});
  push({line->length + left, line->length, none, to, number, true});
}

/// Whether an earlier label at the wheel reaches this one's arrival with no greater length.
bool TangentQuery::is_dominated(const Label& label) const {
  const TurningCircle& circle = graph_->wheel_circle(label.wheel);
  const double to = TangentGraph::sense(label.wheel);
  for (std::uint32_t i = last_label(label.wheel); i != none; i = labels_[i].next) {
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
void TangentQuery::expand(std::uint32_t number) {
  const Label label = labels_[number];
  const std::uint32_t circle = label.wheel / 2;
  if (ends_there_) guess(label, number, {.centre = goal_}, none);
  const bool is_still = circle < graph_->still_count();
  if (is_still) expand_hops(label, number);
  for (std::uint32_t i = is_still ? graph_->still_count() : 0; i < graph_->circle_count(); ++i)
    if (i != circle) guess_both(label, number, i);
}

/// Opens the kept hops.
void TangentQuery::expand_hops(const Label& label, std::uint32_t number) {
  const std::uint32_t at = label.wheel / 2;
  std::vector<Hop>& hops = graph_->hops(label.wheel);
  const bool is_first =  // visit of this circle in this query: none of its hops is open
      label.next == none && last_label(label.wheel ^ 1) == none;
  if (is_first) graph_->visit(at);
  const TurningCircle& circle = graph_->circle(at);
  const bool is_near = is_near_moving(at);
  const double turn = TangentGraph::sense(label.wheel);
  const auto consider = [&](std::size_t i) {
    Hop& hop = hops[i];
    if (hop.walls == TangentGraph::Walls::blocked) return;
    const int arc = is_near ? arc_at(at, hop.leave) : hop.leave_arc;
    if (arc != label.arc) return;
    const double angle = circle.angle_around(turn, label.arrive, hop.leave);
    const double length = label.length + circle.radius * angle + hop.line.length;
    if (hop.query == query_ && hop.best <= length) return;
    hop.query = query_;
    hop.best = length;
    const double left = distance(graph_->touch(hop.to, hop.line), goal_);
    push({length + left, length, number, hop.to, static_cast<std::uint32_t>(i), false});
  };
  const auto ahead = std::ranges::partition_point(
      hops, [&](const Hop& hop) { return turn * hop.leave < turn * label.arrive - angle_slack; });
  const auto first = static_cast<std::size_t>(ahead - hops.begin());
  for (std::size_t i = first; i < hops.size(); ++i) consider(i);
  if (circle.is_disc)  // a full turn
    for (std::size_t i = 0; i < first; ++i) consider(i);
}

void TangentQuery::guess_both(const Label& label, std::uint32_t number, std::uint32_t circle) {
  for (std::uint32_t to = 2 * circle; to < 2 * circle + 2; ++to)
    guess(label, number, graph_->circle(circle), to);
}

std::optional<TangentQuery::Leaving> TangentQuery::leaving(const Label& label,
                                                           const TurningCircle& there,
                                                           double sense_there) {
  const TurningCircle& circle = graph_->wheel_circle(label.wheel);
  const double turn = TangentGraph::sense(label.wheel);
  const auto line = graph_->join(circle, turn, there, sense_there);
  if (!line) return std::nullopt;
  const double leave = graph_->angle_at(label.wheel, *line);
  const double angle = circle.angle_around(turn, label.arrive, leave);
  if (angle < 0 || arc_at(label.wheel / 2, leave) != label.arc) return std::nullopt;
  return Leaving{*line, leave, label.length + circle.radius * angle + line->length};
}

/// Opens the tangent from the label's wheel to another, or to the goal.
void TangentQuery::guess(const Label& label, std::uint32_t number, const TurningCircle& there,
                         std::uint32_t to) {
  const bool ends = to == none;
  const auto line = leaving(label, there, ends ? 1 : TangentGraph::sense(to));
  if (!line) return;
  const double left = ends ? 0 : distance(graph_->touch(to, line->line), goal_);
  push({line->length + left, line->length, number, to, static_cast<std::uint32_t>(guesses_.size()),
        true});
  guesses_.push_back({line->line, line->leave, to});
}

double TangentQuery::reached() const {
  const double next = open_.empty() ? infinity : open_.front().estimate;
  return std::min(next, from_start_.left());
}

std::optional<std::uint32_t> TangentQuery::next(double most) {
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
      label.next = last_label(label.wheel);
      TangentGraph::Mark& mark = graph_->marks()[label.wheel];
      mark.query = query_;
      mark.last_label = number;
    }
    labels_.push_back(label);
    return number;
  }
  return std::nullopt;
}

/// Makes the label of an open line; false if the line is not free or a better one was found.
bool TangentQuery::take(const Open& open, Label& label) {
  const std::uint32_t leaves = open.parent == none ? none : labels_[open.parent].wheel;
  if (!open.is_guess) {
    Hop& hop = graph_->hop(leaves, open.line);
    if (hop.best < open.length || !graph_->test(leaves, hop)) return false;
    label.line = hop.line;
    label.from = graph_->touch(leaves, hop.line);
    label.leave = hop.leave;
    label.arrive = hop.arrive;
    label.wheel = hop.to;
    label.arc = hop.arrive_arc;
    if (!moving_) return true;
    if (is_near_moving(hop.to / 2) && !arrive(label)) return false;
    return moving_->is_free(label.line.from(label.from), graph_->clearance());
  }
  const Guess& guess = guesses_[open.line];
  label.line = guess.line;
  label.leave = guess.leave;
  label.from = leaves == none ? start_ : graph_->touch(leaves, guess.line);
  label.wheel = guess.to;
  if (guess.to != none) {
    label.arrive = graph_->angle_at(guess.to, guess.line);
    if (!arrive(label)) return false;
    return is_free(label.line.from(label.from));
  }
  return is_free({label.from, goal_});
}

/// Finds the arc at which a label arrives; false if it is not free.
bool TangentQuery::arrive(Label& label) {
  const int arc = arc_at(label.wheel / 2, label.arrive);
  label.arc = static_cast<std::uint16_t>(std::max(0, arc));
  return arc >= 0;
}

bool TangentQuery::is_free(Segment s) const {
  return graph_->map().is_free(s, graph_->clearance()) &&
         (!moving_ || moving_->is_free(s, graph_->clearance()));
}

std::vector<Vec2> TangentQuery::path_to(std::uint32_t label) const {
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

void TangentQuery::go_on(const Label& label, const Leaving& leaving, Vec2 position,
                         std::vector<Vec2>& path) const {
  draw_arc(label, leaving.leave, path);
  add(graph_->touch(label.wheel, leaving.line), path);
  add(position, path);
}

void TangentQuery::add(Vec2 p, std::vector<Vec2>& path) const {
  if (distance(p, path.back()) > 0.01 * graph_->margin()) path.push_back(p);
}

/// Adds tangent lines around the arc from the label's arrival to the angle `to`.
void TangentQuery::draw_arc(const Label& label, double to, std::vector<Vec2>& points) const {
  const TurningCircle& circle = graph_->wheel_circle(label.wheel);
  const double sense = TangentGraph::sense(label.wheel);
  const double angle = circle.angle_around(sense, label.arrive, to);
  constexpr double step = 0.1;  // [rad]
  const int count = static_cast<int>(std::ceil(angle / step));
  if (angle < angle_slack) return;
  const double each = angle / count;
  const double outer = circle.radius / maths::cos(0.5 * each);
  for (int i = 0; i < count; ++i) {
    const double normal = circle.from + label.arrive + sense * (i + 0.5) * each;
    add(circle.centre + outer * unit_vector(normal), points);
  }
}

}  // namespace microswarm::planning
