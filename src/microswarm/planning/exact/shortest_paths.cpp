// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/shortest_paths.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

constexpr double slack = 1e-9;  // of angles [rad] and unit vectors

/// [0, 2π).
double positive(double angle) {
  while (angle < 0) angle += 2 * pi;
  while (angle >= 2 * pi) angle -= 2 * pi;
  return angle;
}

}  // namespace

ShortestPaths::ShortestPaths(const Map& map, std::shared_ptr<const Corners> corners,
                             double clearance)
    : map_(map), corners_(std::move(corners)), clearance_(clearance) {
  const Box& box = map.bounds();
  margin_ = std::max(1e-7 * clearance, 1e-10 * std::max(box.width(), box.height()));
  for (const Corner& corner : corners_->all()) {
    Circle circle{.centre = corner.centre,
                  .radius = corner.radius + clearance + margin_,
                  .from = corner.from,
                  .width = corner.width,
                  .is_disc = corner.is_disc()};
    if (!circle.is_disc) {
      circle.first = unit_vector(corner.from);
      circle.last = unit_vector(corner.from + corner.width);
    }
    circles_.push_back(circle);
  }
  wheels_.resize(2 * circles_.size());
  seen_.resize(circles_.size(), 0);
}

/// Finds the free tangents of a circle.
void ShortestPaths::know(std::uint32_t corner) {
  circles_[corner].is_known = true;
  ++look_;
  corners_->seen_from_corner(corner, [&](std::uint32_t other) {
    if (other == corner || seen_[other] == look_) return;
    seen_[other] = look_;
    for (std::uint32_t k = 0; k < 2; ++k)
      for (std::uint32_t l = 0; l < 2; ++l) join_free(2 * corner + k, 2 * other + l);
  });
  for (std::uint32_t k = 0; k < 2; ++k)
    std::ranges::sort(wheels_[2 * corner + k].hops, [&](const Hop& a, const Hop& b) {
      return sense(k) * a.leave < sense(k) * b.leave;
    });
}

/// Adds the tangent of two wheels if it is free.
void ShortestPaths::join_free(std::uint32_t from, std::uint32_t to) {
  Circle& a = circles_[from / 2];
  Circle& b = circles_[to / 2];
  Hop hop{.to = to};
  if (!join(a, sense(from), b, sense(to), hop.line)) return;
  const Vec2 left = perpendicular(hop.line.along);
  hop.leave = angle_in(a, -sense(from) * left);
  const int leave_arc = arc_at(a, hop.leave);
  if (leave_arc < 0) return;
  hop.arrive = angle_in(b, -sense(to) * left);
  const int arrive_arc = arc_at(b, hop.arrive);
  if (arrive_arc < 0 || !is_free(touch(from, hop.line), hop.line)) return;
  hop.leave_arc = static_cast<std::uint16_t>(leave_arc);
  hop.arrive_arc = static_cast<std::uint16_t>(arrive_arc);
  wheels_[from].hops.push_back(hop);
}

/// The tangent of two circles, gone around in these senses; false if there is none that is taut at
/// both. The path leaves a in direction u at the normal −s left(u), so that left(u) · d, with d
/// from centre to centre, is s_b r_b − s_a r_a.
bool ShortestPaths::join(const Circle& a, double sense_a, const Circle& b, double sense_b,
                         Line& line) const {
  const Vec2 d = b.centre - a.centre;
  const double apart2 = squared_norm(d);
  const double offset = sense_b * b.radius - sense_a * a.radius;
  const double inner = apart2 - offset * offset;
  const double apart = std::sqrt(apart2);
  // A place on a circle may lie in it by a rounding error.
  if (apart == 0 || (inner < 0 && std::abs(offset) > apart + 4 * margin_)) return false;
  line.length = std::sqrt(std::max(0.0, inner));
  const double sine = std::clamp(offset / apart, -1.0, 1.0);
  const double cosine = line.length / apart;
  const Vec2 e = d / apart;
  line.along = cosine * e - sine * perpendicular(e);
  const Vec2 left = perpendicular(line.along);
  return is_taut(a, -sense_a * left) && is_taut(b, -sense_b * left);
}

bool ShortestPaths::is_taut(const Circle& circle, Vec2 normal) {
  return circle.is_disc || circle.radius == 0 ||
         (cross(circle.first, normal) >= -slack && cross(normal, circle.last) >= -slack &&
          dot(circle.first + circle.last, normal) > 0);
}

double ShortestPaths::angle_in(const Circle& circle, Vec2 normal) const {
  if (circle.is_disc) return positive(heading_of(normal));
  const double angle = maths::atan2(cross(circle.first, normal), dot(circle.first, normal));
  return std::clamp(angle, 0.0, circle.width);
}

int ShortestPaths::arc_at(Circle& circle, double at) {
  if (!circle.is_cut) find_arcs(circle);
  for (int i = 0; i < circle.arcs; ++i) {
    const Arc& arc = arcs_[circle.first_arc + static_cast<std::uint32_t>(i)];
    if (at >= arc.from - slack && at <= arc.to + slack) return i;
    if (circle.is_disc && at + 2 * pi <= arc.to + slack) return i;
  }
  return -1;
}

/// Cuts the circle where its distance to a wall or to the border is the clearance, and keeps the
/// pieces that are free in the middle.
void ShortestPaths::find_arcs(Circle& circle) {
  circle.is_cut = true;
  std::vector<double> cuts{0, circle.width};
  const Vec2 c = circle.centre;
  const double r = circle.radius;
  const auto cut = [&](Vec2 p) {
    const Vec2 n = p - c;
    const double angle = positive(heading_of(n) - circle.from);
    if (angle < circle.width) cuts.push_back(angle);
  };
  const auto cut_by_line = [&](Vec2 a, Vec2 u, double shift) {  // a + t u, moved to the left
    const Vec2 o = a + shift * perpendicular(u) - c;
    const double b = dot(o, u);
    const double root = b * b - squared_norm(o) + r * r;
    if (root < 0) return;
    for (const double t : {-b - std::sqrt(root), -b + std::sqrt(root)}) cut(c + o + t * u);
  };
  const auto cut_by_circle = [&](Vec2 centre, double radius) {
    const Vec2 d = centre - c;
    const double apart = norm(d);
    if (apart == 0 || apart > r + radius || apart < std::abs(r - radius)) return;
    const double x = (apart * apart + r * r - radius * radius) / (2 * apart);
    const double y = std::sqrt(std::max(0.0, r * r - x * x));
    const Vec2 e = d / apart;
    cut(c + x * e + y * perpendicular(e));
    cut(c + x * e - y * perpendicular(e));
  };
  const double reach = r + clearance_ + margin_;
  const double keep = clearance_ + 0.5 * margin_;
  const Box box = Box{c, c}.grown(reach);
  map_.walls().polygons().for_each_edge_in(box, [&](std::uint32_t, const Segment& edge) {
    const double length = distance(edge.a, edge.b);
    if (length == 0) return;
    const Vec2 u = (edge.b - edge.a) / length;
    cut_by_line(edge.a, u, keep);
    cut_by_line(edge.a, u, -keep);
    if (edge.a != c) cut_by_circle(edge.a, keep);
  });
  map_.walls().discs().for_each_in(box, [&](std::size_t i) {
    const Disc disc = map_.walls().discs().disc(i);
    if (disc.centre != c) cut_by_circle(disc.centre, disc.radius + keep);
  });
  const Box& border = map_.bounds();
  for (const double x : {border.lo.x + keep, border.hi.x - keep}) cut_by_line({x, 0}, {0, 1}, 0);
  for (const double y : {border.lo.y + keep, border.hi.y - keep}) cut_by_line({0, y}, {1, 0}, 0);
  std::ranges::sort(cuts);
  circle.first_arc = static_cast<std::uint32_t>(arcs_.size());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double middle = circle.from + 0.5 * (cuts[i] + cuts[i + 1]);
    if (!map_.is_free(c + r * unit_vector(middle), clearance_)) continue;
    const bool goes_on = arcs_.size() > circle.first_arc && arcs_.back().to == cuts[i];
    if (goes_on)
      arcs_.back().to = cuts[i + 1];
    else
      arcs_.push_back({cuts[i], cuts[i + 1]});
  }
  // The arc over 0 of a disc begins before it.
  const bool is_cut = circle.is_disc && arcs_.size() > circle.first_arc + 1 &&
                      arcs_[circle.first_arc].from == 0 && arcs_.back().to == circle.width;
  if (is_cut) {
    arcs_.back().to += arcs_[circle.first_arc].to;
    arcs_.erase(arcs_.begin() + circle.first_arc);
  }
  circle.arcs = static_cast<std::uint16_t>(arcs_.size() - circle.first_arc);
}

ShortestPaths::Wheel& ShortestPaths::wheel(std::uint32_t number) {
  Wheel& at = wheels_[number];
  if (at.query != query_) {
    at.query = query_;
    at.first_label = none;
  }
  return at;
}

void ShortestPaths::push(const Open& open) {
  open_.push_back(open);
  std::push_heap(open_.begin(), open_.end());
}

/// Opens the tangents from the start.
void ShortestPaths::begin() {
  const Circle here{.centre = start_};
  ++look_;
  corners_->seen_from(start_, [&](std::uint32_t other) {
    if (seen_[other] == look_) return;
    seen_[other] = look_;
    for (std::uint32_t l = 0; l < 2; ++l) {
      Line line;
      if (!join(here, 1, circles_[other], sense(l), line)) continue;
      const auto number = static_cast<std::uint32_t>(starts_.size());
      starts_.push_back({line, 2 * other + l});
      const double left = distance(touch(2 * other + l, line), goal_);
      open_.push_back({line.length + left, line.length, none, number, false});
    }
  });
  std::make_heap(open_.begin(), open_.end());
}

/// Angle from one normal to the next in the sense of rotation; negative if it is not ahead.
double ShortestPaths::way_around(const Circle& circle, double sense, double from, double to) const {
  const double angle = sense * (to - from);
  if (!circle.is_disc) return angle < -slack ? -1 : std::max(0.0, angle);
  const double ahead = positive(angle);
  return ahead > 2 * pi - slack ? 0 : ahead;
}

/// Whether an earlier label at the wheel comes by at no greater length.
bool ShortestPaths::is_dominated(const Label& label) {
  const Circle& circle = circles_[label.wheel / 2];
  const double to = sense(label.wheel);
  for (std::uint32_t i = wheel(label.wheel).first_label; i != none; i = labels_[i].next) {
    const Label& other = labels_[i];
    if (other.arc != label.arc) continue;
    const double angle = way_around(circle, to, other.arrive, label.arrive);
    if (angle >= 0 && (!circle.is_disc || angle < pi) &&
        other.length + circle.radius * angle <= label.length)
      return true;
  }
  return false;
}

/// Opens what leaves the wheel ahead of where the label arrives.
void ShortestPaths::expand(const Label& label, std::uint32_t number) {
  Circle& circle = circles_[label.wheel / 2];
  if (!circle.is_known) know(label.wheel / 2);
  const double turn = sense(label.wheel);
  std::vector<Hop>& hops = wheels_[label.wheel].hops;
  const auto consider = [&](std::size_t i) {
    Hop& hop = hops[i];
    const double angle = way_around(circle, turn, label.arrive, hop.leave);
    const double length = label.length + circle.radius * angle + hop.line.length;
    if (hop.query == query_ && hop.best <= length) return;
    hop.query = query_;
    hop.best = length;
    const double left = distance(touch(hop.to, hop.line), goal_);
    push({length + left, length, number, static_cast<std::uint32_t>(i), false});
  };
  const auto ahead = std::ranges::partition_point(
      hops, [&](const Hop& hop) { return turn * hop.leave < turn * label.arrive - slack; });
  for (auto i = static_cast<std::size_t>(ahead - hops.begin()); i < hops.size(); ++i)
    if (hops[i].leave_arc == label.arc) consider(i);
  if (circle.is_disc)  // once around
    for (std::size_t i = 0; i < static_cast<std::size_t>(ahead - hops.begin()); ++i)
      if (hops[i].leave_arc == label.arc) consider(i);

  Line line;
  if (!join(circle, turn, Circle{.centre = goal_}, 1, line)) return;
  const double leave = angle_in(circle, -turn * perpendicular(line.along));
  const double angle = way_around(circle, turn, label.arrive, leave);
  if (angle < 0 || arc_at(circle, leave) != label.arc) return;
  const double length = label.length + circle.radius * angle + line.length;
  push({length, length, number, static_cast<std::uint32_t>(ends_.size()), true});
  ends_.push_back({line, leave});
}

ShortestPath ShortestPaths::find(Vec2 start, Vec2 goal, const Stop& stop) {
  ShortestPath path;
  start_ = start;
  goal_ = goal;
  ++query_;
  labels_.clear();
  open_.clear();
  starts_.clear();
  ends_.clear();
  ++path.checks;
  if (map_.is_free(Segment{start, goal}, clearance_)) {
    path.status = Status::solved;
    path.length = distance(start, goal);
    path.points = {start, goal};
    return path;
  }
  begin();
  while (!open_.empty()) {
    if (path.expanded % 64 == 0)
      if (const auto told = stop.status()) {
        path.status = *told;
        return path;
      }
    std::pop_heap(open_.begin(), open_.end());
    const Open open = open_.back();
    open_.pop_back();
    Label label{.length = open.length, .parent = open.parent};
    if (!take(open, label, path)) continue;
    const auto number = static_cast<std::uint32_t>(labels_.size());
    if (open.is_end) {
      labels_.push_back(label);
      path.status = Status::solved;
      path.length = open.length;
      draw(number, path);
      return path;
    }
    if (is_dominated(label)) continue;
    label.next = std::exchange(wheel(label.wheel).first_label, number);
    labels_.push_back(label);
    ++path.expanded;
    expand(label, number);
  }
  return path;
}

/// The label of an open line; false if the line is not free or a better one was found.
bool ShortestPaths::take(const Open& open, Label& label, ShortestPath& path) {
  if (open.parent == none) {
    const FromStart& first = starts_[open.line];
    label.line = first.line;
    label.from = start_;
    label.wheel = first.to;
    Circle& there = circles_[first.to / 2];
    label.arrive = angle_in(there, -sense(first.to) * perpendicular(first.line.along));
    const int arc = arc_at(there, label.arrive);
    if (arc < 0) return false;
    label.arc = static_cast<std::uint16_t>(arc);
    ++path.checks;
    return is_free(label.from, label.line);
  }
  const std::uint32_t leaves = labels_[open.parent].wheel;
  if (open.is_end) {
    const ToGoal& last = ends_[open.line];
    label.line = last.line;
    label.leave = last.leave;
    label.from = touch(leaves, last.line);
    ++path.checks;
    return is_free(label.from, label.line);
  }
  const Hop& hop = wheels_[leaves].hops[open.line];
  if (hop.best < open.length) return false;
  label.line = hop.line;
  label.leave = hop.leave;
  label.arrive = hop.arrive;
  label.arc = hop.arrive_arc;
  label.wheel = hop.to;
  label.from = touch(leaves, hop.line);
  return true;
}

void ShortestPaths::draw(std::uint32_t last, ShortestPath& path) const {
  std::vector<std::uint32_t> chain;
  for (std::uint32_t i = last; i != none; i = labels_[i].parent) chain.push_back(i);
  std::ranges::reverse(chain);
  path.points = {start_};
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Label& label = labels_[chain[k]];
    if (k > 0) {
      const Label& before = labels_[chain[k - 1]];
      draw_arc(circles_[before.wheel / 2], sense(before.wheel), before.arrive, label.leave,
               path.points);
      path.points.push_back(label.from);
    }
    path.points.push_back(label.from + label.line.length * label.line.along);
  }
  path.points.back() = goal_;
}

/// Adds lines around the arc, each of which touches it.
void ShortestPaths::draw_arc(const Circle& circle, double sense, double from, double to,
                             std::vector<Vec2>& points) const {
  const double angle = way_around(circle, sense, from, to);
  constexpr double step = 0.26;  // [rad]
  const int count = static_cast<int>(std::ceil(angle / step));
  if (angle < slack) return;
  const double each = angle / count;
  const double outer = circle.radius / maths::cos(0.5 * each);
  for (int i = 0; i < count; ++i)
    points.push_back(circle.centre +
                     outer * unit_vector(circle.from + from + sense * (i + 0.5) * each));
}

}  // namespace microswarm
