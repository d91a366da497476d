// SPDX-License-Identifier: Apache-2.0
#include "bench/swarm.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "bench/naive_robots.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/formats/images/rasterise.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/scenes/vascular.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "microswarm/world/connectivity/passage.hpp"

namespace microswarm::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int robots_stepped = 1024;
constexpr int moves_a_heading = 25;

std::vector<Vec2> free_places(const Map& map, double clearance, Rng& rng) {
  std::vector<Vec2> positions;
  const Box& b = map.bounds();
  for (int draw = 0; draw < 1'000'000 && std::ssize(positions) < robots_stepped; ++draw) {
    const Vec2 p = uniform_in(b, rng);
    if (map.is_free(p, clearance)) positions.push_back(p);
  }
  return positions;
}

/// Moves with a new random heading every few moves.
std::vector<Vec2> moves(double length, int count, Rng& rng) {
  std::vector<Vec2> all;
  Vec2 move;
  for (int k = 0; k < count; ++k) {
    if (k % moves_a_heading == 0) move = length * unit_vector(rng.uniform(0, 2 * pi));
    all.push_back(move);
  }
  return all;
}

/// Robot-steps per second: median of several repetitions from the same positions.
template <class Start>
double rate(const std::vector<Vec2>& all, int repeats, const Stop& stop, Start&& start) {
  std::vector<double> rates;
  for (int k = 0; k < repeats && !stop(); ++k) {
    auto step = start();
    const auto began = Clock::now();
    for (const Vec2 move : all) step(move);
    const double took = std::chrono::duration<double>(Clock::now() - began).count();
    rates.push_back(static_cast<double>(all.size()) * robots_stepped / took);
  }
  return rates.empty() ? 0 : quantile(rates, 0.5);
}

void add_rows(std::vector<report::BenchRow>& rows, const std::string& name, const Map& map,
              double step, double aim, bool quick, const Stop& stop) {
  const RobotStepper stepper(map, step);
  Rng rng(1, Purpose::scene);
  const std::vector<Vec2> positions = free_places(map, 4 * stepper.guard(), rng);
  const int repeats = quick ? 3 : 9;
  const auto faces = static_cast<int>(stepper.faces().all().size());
  const std::vector<Vec2> few = moves(step, std::clamp(200'000 / faces, 5, quick ? 50 : 200), rng);
  const double naive = rate(few, quick ? 1 : 3, stop, [&] {
    return [robots = NaiveRobots(map, positions)](Vec2 move) mutable { robots.step(move); };
  });
  const std::vector<Vec2> many = moves(step, quick ? 1000 : 8000, rng);
  for (const ContactRule rule : {ContactRule::stop, ContactRule::slide}) {
    const double ours = rate(many, repeats, stop, [&] {
      return [&, robots = stepper.place(positions)](Vec2 move) mutable {
        stepper.step(robots, move, rule);
      };
    });
    const bool stops = rule == ContactRule::stop;
    constexpr double slide_aim = 65e6;
    rows.push_back({.name = name + (stops ? ", robots stop" : ", robots slide"),
                    .quantity = "robot-steps per second",
                    .unit = "1/s",
                    .ours = ours,
                    .peer = naive,
                    .peer_name = "every edge in turn, stop",
                    .aim = stops ? aim : slide_aim,
                    .at_most = false});
  }
}

/// A map as given by a camera: square pixels, with steps along slanted walls.
Map of_pixels(const Map& map, double pixel) {
  return {map.bounds(),
          formats::mask_walls(formats::rasterise(map, pixel), pixel, map.bounds().lo)};
}

/// Vessel masks of retinas, with steps of a tenth of their widest channel, if MICROSWARM_DATA names
/// the folder of real input.
void add_retinas(std::vector<report::BenchRow>& rows, bool quick, const Stop& stop) {
  constexpr double um_per_px = 6;
  const char* data = std::getenv("MICROSWARM_DATA");
  if (!data) return;
  for (const char* name : {"CHASE_01L", "CHASE_05R", "CHASE_12R"}) {
    const auto file =
        std::filesystem::path(data) / "vessels" / (std::string(name) + "_mask_obs1.png");
    if (!std::filesystem::exists(file) || stop()) continue;
    const formats::LoadedMap map = formats::load_map(formats::guess_map_spec(file, um_per_px));
    add_rows(rows, std::string("retina ") + name, *map.map, check_map(*map.map).widest / 10, 65e6,
             quick, stop);
  }
}

}  // namespace

std::vector<report::BenchRow> swarm(bool quick, const Stop& stop) {
  std::vector<report::BenchRow> rows;
  add_rows(rows, "T-junction", scenes::t_junction().map(), 1, 200e6, quick, stop);
  add_rows(rows, "vascular map, 100 × 100", scenes::vascular_network().map(), 1, 65e6, quick, stop);
  add_rows(rows, "vascular map, 400 × 314", scenes::larger_vascular_network().map(), 1, 65e6, quick,
           stop);
  add_rows(rows, "the same of pixels of 0.5 µm",
           of_pixels(scenes::larger_vascular_network().map(), 0.5), 1, 65e6, quick, stop);
  add_retinas(rows, quick, stop);
  return rows;
}

}  // namespace microswarm::bench
