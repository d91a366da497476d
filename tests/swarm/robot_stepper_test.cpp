// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/robots/robot_stepper.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "tests/cases.hpp"
#include "tests/each_target.hpp"

namespace microswarm {
namespace {

constexpr std::array rules{ContactRule::slide, ContactRule::stop, ContactRule::reject};

Polygon box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

/// Walls of half a µm, needles down to 0.01 µm and discs, crossing each other.
Map thin_and_sharp() {
  Rng rng(5, Purpose::scene);
  std::vector<Polygon> walls;
  std::vector<Disc> discs;
  const auto position = [&] {
    const double x = rng.uniform(0, 1000);
    return Vec2{x, rng.uniform(0, 1000)};
  };
  for (int i = 0; i < 40; ++i) {
    const Vec2 p = position();
    const Vec2 along = unit_vector(rng.uniform(0, 2 * pi));
    const Vec2 across{-along.y, along.x};
    const Vec2 end = p + rng.uniform(20, 200) * along;
    walls.push_back({{p, end, end + 0.5 * across, p + 0.5 * across}, {}});
    const Vec2 q = position();
    walls.push_back({{q, q + rng.uniform(20, 150) * along, q + rng.uniform(0.01, 5) * across}, {}});
    if (i % 2 == 0) discs.push_back({position(), rng.uniform(1, 30)});
  }
  return {{{0, 0}, {1000, 1000}}, walls, discs};
}

/// Squares as of pixels: many touch in corners only.
Map chequered() {
  Rng rng(6, Purpose::scene);
  std::vector<Polygon> walls;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      if (rng.below(2) == 0) walls.push_back(box(10 * i, 10 * j, 10 * i + 10, 10 * j + 10));
  return {{{0, 0}, {100, 100}}, walls};
}

/// Squares as of a vessel mask: more faces near a robot than a pack holds.
Map finely_chequered() {
  Rng rng(7, Purpose::scene);
  std::vector<Polygon> walls;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j)
      if (rng.below(3) == 0) walls.push_back(box(2 * i, 2 * j, 2 * i + 2, 2 * j + 2));
  return {{{0, 0}, {60, 60}}, walls};
}

/// The T-junction of [gather].
Map t_junction() { return {{{0, 50}, {100, 100}}, {box(0, 50, 45, 90), box(55, 50, 100, 90)}}; }

struct Case {
  const char* name;
  Map map;
  double reach;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"thin and sharp", thin_and_sharp(), 5});
  all.push_back({"chequered", chequered(), 1});
  all.push_back({"many faces near", finely_chequered(), 4});
  all.push_back({"T-junction", t_junction(), 1});
  return all;
}

std::vector<Vec2> free_places(const Map& map, double clearance, int count, Rng& rng) {
  std::vector<Vec2> positions;
  const Box& b = map.bounds();
  for (int draw = 0; draw < 1000 * count && std::ssize(positions) < count; ++draw) {
    const Vec2 p = uniform_in(b, rng);
    if (map.is_free(p, clearance)) positions.push_back(p);
  }
  return positions;
}

TEST(RobotStepper, NoRobotEverLeavesFreeSpace) {
  for (const Case& c : cases()) {
    const RobotStepper stepper(c.map, c.reach);
    for (const ContactRule rule : rules) {
      Rng rng(7, Purpose::scene);
      Robots robots = stepper.place(free_places(c.map, 4 * stepper.guard(), 203, rng));
      double heading = 0;
      for (int k = 0; k < 600; ++k) {
        if (k % 20 == 0) heading = rng.uniform(0, 2 * pi);
        // Headings along the walls and along diagonals too; pieces and long moves too.
        if (k % 60 == 0) heading = pi / 4 * static_cast<double>(rng.below(8));
        const double length = c.reach * (k % 7 == 0 ? rng.uniform(0, 4) : 1);
        std::vector<Vec2> before;
        for (std::size_t i = 0; i < robots.size(); ++i) before.push_back(robots.position(i));
        stepper.step(robots, length * unit_vector(heading), rule);
        for (std::size_t i = 0; i < robots.size(); ++i) {
          const Vec2 p = robots.position(i);
          ASSERT_TRUE(c.map.is_free(p, 0.5 * stepper.guard()))
              << c.name << " robot " << i << " step " << k << " at " << p.x << ' ' << p.y;
          if (rule != ContactRule::slide) {
            ASSERT_TRUE(c.map.is_free(Segment{before[i], p}, 0));
          }
        }
      }
    }
  }
}

TEST(RobotStepper, NothingSlipsInExactlyAlongTheDiagonalOfASquareCorner) {
  std::vector<Polygon> walls;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      walls.push_back(box(600 * i + 300, 600 * j + 300, 600 * i + 306, 600 * j + 306));
  const Map map({{0, 0}, {5994, 5760}}, walls);
  const RobotStepper stepper(map, 4);
  Rng rng(8, Purpose::scene);
  std::vector<Vec2> starts;
  for (int k = 0; k < 4000; ++k) {
    const double i = static_cast<double>(rng.below(10)), j = static_cast<double>(rng.below(10));
    const double back = static_cast<double>(800 + rng.below(20'000)) / 8192;  // no rounding
    starts.push_back({600 * i + 300 - back, 600 * j + 300 - back});
  }
  for (const double length : {2.0, 2.828, 3.0, 3.7, 4.0})
    for (const ContactRule rule : rules) {
      Robots robots = stepper.place(starts);
      for (int k = 0; k < 3; ++k) {
        stepper.step(robots, length * unit_vector(pi / 4), rule);
        for (const Vec2 p : robots.positions()) ASSERT_TRUE(map.is_free(p, 0)) << p.x << ' ' << p.y;
      }
    }
}

/// Robots of the case after 300 moves, by vectors and one by one.
void expect_bits_of_the_plain_form(const Case& c, ContactRule rule, const char* target) {
  const RobotStepper stepper(c.map, c.reach);
  Rng rng(8, Purpose::scene);
  Robots robots = stepper.place(free_places(c.map, 4 * stepper.guard(), 61, rng));
  Robots plain = robots;
  for (int k = 0; k < 300; ++k) {
    const Vec2 move = c.reach * rng.uniform(0, 1.5) * unit_vector(rng.uniform(0, 2 * pi));
    const PointF m{static_cast<float>(move.x), static_cast<float>(move.y)};
    stepper.step(robots, move, rule);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const PointF p = stepper.moved({plain.x[i], plain.y[i]}, m, rule);
      plain.x[i] = p.x;
      plain.y[i] = p.y;
    }
    ASSERT_EQ(robots.x, plain.x) << c.name << ' ' << target;
    ASSERT_EQ(robots.y, plain.y) << c.name << ' ' << target;
  }
}

TEST(RobotStepper, LanesOfEveryWidthGiveTheBitsOfThePlainForm) {
  test::for_each_target([](const char* target) {
    for (const Case& c : cases())
      for (const ContactRule rule : rules) expect_bits_of_the_plain_form(c, rule, target);
  });
}

TEST(RobotStepper, ManyMovesOfOneRobotGiveTheBitsOfOneByOne) {
  test::for_each_target([](const char* target) {
    for (const Case& c : cases()) {
      const RobotStepper stepper(c.map, c.reach);
      Rng rng(10, Purpose::scene);
      for (const Vec2 position : free_places(c.map, 4 * stepper.guard(), 40, rng)) {
        std::vector<PointF> moves(70);
        for (PointF& m : moves) {
          // Some too short to leave a wall, some of several pieces.
          const double length = rng.below(4) == 0 ? stepper.guard() : c.reach;
          const Vec2 move = length * rng.uniform(0, 3) * unit_vector(rng.uniform(0, 2 * pi));
          m = {static_cast<float>(move.x), static_cast<float>(move.y)};
        }
        for (const ContactRule rule : rules) {
          const PointF p = stepper.moved(stepper.relative(position), moves.back(), rule);
          std::vector<PointF> ends(moves.size());
          stepper.moved(p, moves, rule, ends);
          for (std::size_t k = 0; k < moves.size(); ++k) {
            const PointF end = stepper.moved(p, moves[k], rule);
            ASSERT_TRUE(ends[k].x == end.x && ends[k].y == end.y) << c.name << ' ' << target;
          }
        }
      }
    }
  });
}

TEST(FaceGrid, ListsOfADirectionLeaveOutNothingThatAMoveMeets) {
  const Map map = finely_chequered();
  for (const double reach : {0.5, 2.0, 5.0}) {
    const WallFaces faces(map, reach);
    Rng rng(11, Purpose::scene);
    std::size_t longest = 0;
    for (int k = 0; k < 30'000; ++k) {
      const PointF p{static_cast<float>(rng.uniform(-30, 30)),
                     static_cast<float>(rng.uniform(-30, 30))};
      const double angle =
          rng.below(2) == 0 ? pi / 4 * static_cast<double>(rng.below(8)) : rng.uniform(0, 2 * pi);
      const double length = rng.below(4) == 0 ? 10 * faces.guard() : reach;
      const Vec2 move = length * rng.uniform(0, 1) * unit_vector(angle);
      const PointF m{static_cast<float>(move.x), static_cast<float>(move.y)};
      const FaceGrid& grid = faces.grid();
      FaceContact near, any;
      for (const FacePack& pack : grid.near(grid.cell_at(p), grid.move_direction(m)))
        for (std::size_t i = 0; i < FacePack::size; ++i) {
          const float time = time_to_contact(pack[i], p, m, faces.guard());
          if (time < near.time) near = {time, pack[i].normal};
        }
      for (const WallFace& face : faces.all()) {
        const float time = time_to_contact(face, p, m, faces.guard());
        if (time < any.time) any = {time, face.normal};
      }
      ASSERT_EQ(near.time, any.time);
      ASSERT_EQ(near.normal.x, any.normal.x);
      ASSERT_EQ(near.normal.y, any.normal.y);
      longest = std::max(longest, faces.near(p).size());
    }
    EXPECT_GT(longest, reach > 1 ? 1u : 0u);
  }
}

// In double precision: the whole move where it is free, else up to about the first wall.
TEST(RobotStepper, StopsWhereTheExactMapSaysSo) {
  for (const Case& c : cases()) {
    const RobotStepper stepper(c.map, c.reach);
    const double guard = stepper.guard();
    Rng rng(9, Purpose::scene);
    for (const Vec2 p : free_places(c.map, 4 * guard, 3000, rng)) {
      const Vec2 move = c.reach * unit_vector(rng.uniform(0, 2 * pi));
      const PointF q = stepper.moved(stepper.relative(p),
                                     {static_cast<float>(move.x), static_cast<float>(move.y)},
                                     ContactRule::stop);
      const Vec2 end = c.map.bounds().centre() + Vec2{q.x, q.y};
      const double way = distance(p, end);
      ASSERT_LT(distance(end, p + (way / norm(move)) * move), 0.5 * guard);
      // Discs are taken a little larger than they are.
      const double slack = 3 * guard + 0.04;
      if (c.map.is_free(Segment{p, p + move}, slack)) {
        EXPECT_NEAR(way, norm(move), 0.5 * guard) << c.name;
      }
      if (!c.map.is_free(Segment{p, p + move}, 0)) {
        EXPECT_LT(way, norm(move));
        EXPECT_LT(c.map.clearance(Segment{p, p + move}, 1), slack);
        EXPECT_FALSE(c.map.is_free(Segment{end, p + move}, 0));
      }
    }
  }
}

Vec2 moved(const RobotStepper& stepper, const Map& map, Vec2 p, Vec2 move, ContactRule rule) {
  const PointF q = stepper.moved(stepper.relative(p),
                                 {static_cast<float>(move.x), static_cast<float>(move.y)}, rule);
  return map.bounds().centre() + Vec2{q.x, q.y};
}

TEST(RobotStepper, SlidesAlongTheWallAndIsHeldInACorner) {
  const Map map({{0, 0}, {100, 100}}, {box(40, 0, 60, 50)});
  const RobotStepper stepper(map, 5);
  const double near = 3 * stepper.guard();
  const auto slide = [&](Vec2 p, Vec2 move) {
    return moved(stepper, map, p, move, ContactRule::slide);
  };
  EXPECT_LT(distance(slide({10, 2}, {3, -4}), Vec2{13, 0}), near);
  EXPECT_LT(distance(slide({39, 1}, {3, -4}), Vec2{40, 0}), near);    // from wall to wall
  EXPECT_LT(distance(slide({1, 1}, {-3, -3}), Vec2{0, 0}), near);     // into the corner
  EXPECT_LT(distance(slide({39, 48}, {3, 4}), Vec2{40, 52}), near);   // past the end of the wall
  EXPECT_LT(distance(slide({10, 2}, {60, -4}), Vec2{40, 0}), near);   // a long move, in pieces
  EXPECT_LT(distance(slide({50, 51}, {0, -4}), Vec2{50, 50}), near);  // square on
}

TEST(RobotStepper, StopsOrDoesNotMove) {
  const Map map({{0, 0}, {100, 100}}, {box(40, 0, 60, 50)});
  const RobotStepper stepper(map, 5);
  const double near = 3 * stepper.guard();
  EXPECT_LT(distance(moved(stepper, map, {10, 2}, {3, -4}, ContactRule::stop), Vec2{11.5, 0}),
            near);
  EXPECT_EQ(moved(stepper, map, {10, 2}, {3, -4}, ContactRule::reject), (Vec2{10, 2}));
  EXPECT_EQ(moved(stepper, map, {10, 20}, {90, 0}, ContactRule::reject), (Vec2{10, 20}));
  EXPECT_LT(distance(moved(stepper, map, {10, 20}, {90, 0}, ContactRule::stop), Vec2{40, 20}),
            near);
  EXPECT_EQ(moved(stepper, map, {10, 20}, {0, 0}, ContactRule::slide), (Vec2{10, 20}));
}

// The same input again and again along a wall is rounded the same way each time: towards the wall,
// for some slants.
TEST(RobotStepper, ThousandsOfEqualMovesAlongSlantingWallsDoNotCreepIntoThem) {
  for (int i = 1; i < test::cases(400); i += 7) {
    const double slant = 0.0005 * i;
    const Map map({{0, 0}, {400, 500}},
                  {Polygon{{{0, 0}, {31, 0}, {31 + 500 * slant, 500}, {0, 500}}, {}}});
    const RobotStepper stepper(map, 3.2);
    const Vec2 along = Vec2{slant, 1} / norm(Vec2{slant, 1});
    const Vec2 off{along.y, -along.x};
    for (const double length : {0.05, 0.3, 1.0}) {
      for (const double lean : {-10.0, -0.2, -1e-3, -1e-5, -1e-6, -1e-7, 0.0, 1e-8, 1e-7}) {
        const Vec2 move = length * (along + lean * off);
        const PointF m{static_cast<float>(move.x), static_cast<float>(move.y)};
        for (const ContactRule rule :
             {ContactRule::slide, ContactRule::stop, ContactRule::reject}) {
          PointF p = stepper.relative({31 + 20 * slant + 5, 20});
          for (int k = 0; k < 20; ++k) p = stepper.moved(p, {-0.5F, 0}, ContactRule::stop);
          Vec2 q;
          for (int k = 0; k < 2000 && q.y < 490; ++k) {
            p = stepper.moved(p, m, rule);
            q = stepper.faces().origin() + Vec2{static_cast<double>(p.x), static_cast<double>(p.y)};
          }
          ASSERT_TRUE(map.is_free(q, 0)) << slant << ' ' << length << ' ' << lean;
          if (rule != ContactRule::slide || lean < -1) continue;
          ASSERT_GT(q.y, std::min(400.0, 1000 * length)) << "held by a plain wall";
        }
      }
    }
  }
}

}  // namespace
}  // namespace microswarm
