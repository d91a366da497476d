// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/global_worlds.hpp"

#include <cassert>
#include <vector>

namespace microswarm::scenes {
namespace {

struct Bar {
  double x, y, width, height;
};

std::vector<Bar> bars(int number) {
  switch (number) {
    case 1:
      return {{175, 150, 100, 25}, {150, 150, 25, 100}};
    case 2:
      return {{200, 210, 10, 140}, {200, 50, 10, 140}};
    case 3:
      return {{150, 210, 100, 140}, {150, 50, 100, 140}};
    default:
      assert(number == 4);
      return {{150, 250, 100, 100}, {150, 50, 100, 100}, {150, 200, 10, 50}, {195, 200, 10, 50},
              {240, 200, 10, 50},   {173, 150, 10, 50},  {220, 150, 10, 50}};
  }
}

}  // namespace

Map global_world(int number) {
  std::vector<Polygon> walls;
  for (const Bar& b : bars(number)) {
    const Vec2 lo{b.x, b.y};
    const Vec2 hi{b.x + b.width, b.y + b.height};
    walls.push_back({{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, {}});
  }
  return {{{50, 50}, {350, 350}}, walls};
}

}  // namespace microswarm::scenes
