// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/exact/tangent_graph.hpp"

#include <algorithm>

namespace microswarm::planning {
namespace {

constexpr std::uint8_t often = 8;  // queries that visit a circle before its hops are settled

}  // namespace

TangentGraph::TangentGraph(const Map& map, double clearance)
    : map_(&map), corners_(&map.corners()), clearance_(clearance) {
  const Box& box = map.bounds();
  margin_ = std::max(1e-7 * clearance, 1e-10 * std::max(box.width(), box.height()));
  circles_.reserve(corners_->all().size());
  for (const Corner& corner : corners_->all()) circles_.push_back(around(corner));
  wheels_.resize(2 * circles_.size());
  seen_.resize(2 * circles_.size(), 0);
  bytes_ = circles_.size() * (sizeof(Circle) + 2 * sizeof(Wheel));
}

TangentGraph::Circle TangentGraph::around(const Corner& corner) const {
  return {{.centre = corner.centre,
           .radius = corner.radius + clearance_ + margin_,
           .from = corner.from,
           .width = corner.width,
           .first = corner.first,
           .last = corner.last,
           .is_disc = corner.is_disc}};
}

std::uint32_t TangentGraph::begin_query(const BodySet* moving) {
  std::vector<Corner> corners;
  if (moving)
    for (const Body& body : moving->bodies()) add_corners(body, map_->bounds(), corners);
  circles_.resize(still_count());
  for (const Corner& corner : corners) circles_.push_back(around(corner));
  wheels_.resize(2 * circles_.size());
  marks_.resize(2 * circles_.size());
  return ++query_;
}

void TangentGraph::find_hops(std::uint32_t wheel) {
  const Circle& circle = circles_[wheel / 2];
  Wheel& at = wheels_[wheel];
  at.is_known = true;
  ++look_;
  corners_->seen_from(
      wheel / 2, circle.radius, clearance_, sense(wheel) > 0,
      [&](std::uint32_t corner, auto&& sides) {
        take_unseen(
            corner, sides, [this](std::uint32_t number) -> std::uint32_t& { return seen_[number]; },
            look_,
            [&](std::uint32_t to) {
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
void TangentGraph::add_hop(std::uint32_t from, std::uint32_t to) {
  const auto line = join(wheel_circle(from), sense(from), wheel_circle(to), sense(to));
  if (!line) return;
  Hop hop{.line = *line, .leave = angle_at(from, *line), .to = to};
  const int arc = arc_at(from / 2, hop.leave);
  if (arc < 0) return;
  hop.leave_arc = static_cast<std::uint16_t>(arc);
  wheels_[from].hops.push_back(hop);
}

bool TangentGraph::test(std::uint32_t from, Hop& hop) {
  if (hop.walls != Walls::unknown) return hop.walls == Walls::free;
  hop.walls = Walls::blocked;
  hop.arrive = angle_at(hop.to, hop.line);
  const int arc = arc_at(hop.to / 2, hop.arrive);
  if (arc < 0) return false;
  hop.arrive_arc = static_cast<std::uint16_t>(arc);
  if (map_->is_free(hop.line.from(touch(from, hop.line)), clearance_)) hop.walls = Walls::free;
  return hop.walls == Walls::free;
}

void TangentGraph::visit(std::uint32_t circle) {
  Circle& at = circles_[circle];
  if (at.visits >= often || ++at.visits < often) return;
  settle(2 * circle);
  settle(2 * circle + 1);
}

/// Tests all hops of a wheel and forgets the blocked ones.
void TangentGraph::settle(std::uint32_t wheel) {
  std::erase_if(wheels_[wheel].hops, [&](Hop& hop) { return !test(wheel, hop); });
}

int TangentGraph::arc_at(std::uint32_t circle, double angle) {
  Circle& at = circles_[circle];
  if (!at.is_cut) {
    at.is_cut = true;
    at.arcs = cut(circle, nullptr, arcs_);
  }
  return microswarm::planning::arc_at(at, angle, at.arcs.of(arcs_));
}

TangentGraph::ArcRange TangentGraph::cut(std::uint32_t circle, const BodySet* bodies,
                                         std::vector<Arc>& arcs) const {
  const std::size_t first = arcs.size();
  add_free_arcs(circles_[circle], *map_, bodies, clearance_, margin_, arcs);
  return {static_cast<std::uint32_t>(first), static_cast<std::uint16_t>(arcs.size() - first)};
}

}  // namespace microswarm::planning
