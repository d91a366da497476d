// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/pieces.hpp"

#include <cstdint>
#include <numeric>
#include <utility>

#include "microswarm/world/obstacles/clip.hpp"
#include "microswarm/world/obstacles/contacts.hpp"

namespace microswarm {
namespace {

/// Disjoint sets of indices; a set is named by its lowest index.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t name(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    i = name(i);
    j = name(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<Body> connected_pieces(std::vector<Polygon> polygons, const std::vector<Disc>& discs) {
  const std::size_t solids = polygons.size() + discs.size();
  Groups touching(solids);
  Groups merging(polygons.size());
  std::vector<bool> must_clip(polygons.size(), false);
  const std::vector<Contact> contacts = find_contacts(polygons, discs);
  for (const Contact& c : contacts) {
    if (c.first == c.second) must_clip[c.first] = true;
  }
  std::vector<bool> has_area = must_clip;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    has_area[i] = has_area[i] || signed_area(polygons[i].outer) > 0;
  }
  for (const Contact& c : contacts) {
    touching.join(c.first, c.second);
    if (!c.overlap || !has_area[c.first] || !has_area[c.second]) continue;
    must_clip[c.first] = must_clip[c.second] = true;
    merging.join(c.first, c.second);
  }

  std::vector<std::vector<Polygon>> groups(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    groups[merging.name(i)].push_back(std::move(polygons[i]));
  }
  constexpr std::uint32_t unnamed = ~0u;
  std::vector<std::uint32_t> number(solids, unnamed);
  std::uint32_t pieces = 0;
  auto piece_number = [&](std::size_t i) {
    std::uint32_t& n = number[touching.name(i)];
    if (n == unnamed) n = pieces++;
    return n;
  };
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].empty()) continue;
    if (must_clip[i]) groups[i] = united(groups[i]);
    for (Polygon& p : groups[i])
      bodies.push_back({.shape = std::move(p), .obstacle = piece_number(i)});
  }
  for (std::size_t i = 0; i < discs.size(); ++i) {
    bodies.push_back({.shape = discs[i], .obstacle = piece_number(groups.size() + i)});
  }
  return bodies;
}

}  // namespace microswarm
