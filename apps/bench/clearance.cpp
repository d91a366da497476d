// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "bench/ompl_peer.hpp"
#include "bench/planning.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/formats/moving_ai.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::bench {
namespace {

/// Median rate [1/s] of `ask`, which asks `count` questions at once and returns how many say yes.
template <class Ask>
double rate_of_all(std::size_t count, int repeats, Ask&& ask) {
  std::vector<double> rate;
  std::size_t sum = 0;
  for (int k = 0; k < repeats; ++k) {
    const auto began = std::chrono::steady_clock::now();
    sum += ask();
    rate.push_back(static_cast<double>(count) / seconds_since(began));
  }
  return sum > count * static_cast<std::size_t>(repeats) ? 0 : quantile(rate, 0.5);
}

/// The same for an `ask` that answers one question.
template <class Ask>
double call_rate(std::size_t count, int repeats, Ask&& ask) {
  return rate_of_all(count, repeats, [&] {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += ask(i);
    return sum;
  });
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

std::vector<report::BenchRow> clearance_queries(bool quick) {
  Rng rng(1, Purpose::scene);
  const scenes::RawWorld raw = scenes::cluttered(rng);
  const Snapshot world = raw.snapshot();
  constexpr double clearance = 40;
  const std::size_t n = quick ? 200'000 : 1'000'000;
  std::vector<Segment> edges(n);
  std::vector<Vec2> positions;
  for (Segment& e : edges) {
    e.a = uniform_in(world.bounds(), rng);
    e.b = e.a + 40 * unit_vector(rng.uniform(0, 2 * pi));
    positions.push_back(e.a);
  }
  const int repeats = quick ? 5 : 11;
  const std::size_t few = n / 200;
  const double one_by_one =
      call_rate(n, repeats, [&](std::size_t i) { return world.is_free(positions[i], clearance); });
  std::vector<std::uint8_t> free(n);
  return {
      {.name = "is the place free, clearance 40 µm",
       .quantity = "queries per second",
       .unit = "1/s",
       .ours = one_by_one,
       .peer = call_rate(few, repeats,
                         [&](std::size_t i) { return raw.clearance(positions[i]) >= clearance; }),
       .peer_name = "every shape in turn",
       .at_most = false},
      {.name = "are the places free, clearance 40 µm, all at once",
       .quantity = "queries per second",
       .unit = "1/s",
       .ours = rate_of_all(n, repeats,
                           [&] {
                             world.are_free(positions, clearance, free);
                             return std::size_t{free[n / 2]};
                           }),
       .peer = one_by_one,
       .peer_name = "one by one",
       .aim = 1e8,
       .at_most = false},
      {.name = "is the 40 µm edge free, clearance 40 µm, exact",
       .quantity = "checks per second",
       .unit = "1/s",
       .ours =
           call_rate(n, repeats, [&](std::size_t i) { return world.is_free(edges[i], clearance); }),
       .peer = ompl_motion_rate(world, clearance,
                                {edges.begin(), edges.begin() + static_cast<long>(n / 4)}),
       .peer_name = "OMPL discrete, 1 %, our points",
       .aim = 2.5e7,
       .at_most = false}};
}

std::vector<report::BenchRow> map_loading(bool quick, const Stop& stop) {
  const char* data = std::getenv("MICROSWARM_DATA");
  if (!data) return {};
  const auto file = std::filesystem::path(data) / "grid_maps" / "random512-10-0.map";
  if (!std::filesystem::exists(file)) return {};
  constexpr double cell = 100;
  std::vector<double> seconds;
  for (int k = 0; k < (quick ? 3 : 11) && !stop(); ++k) {
    const double began = processor_seconds();
    const formats::Mask blocked = formats::read_moving_ai(file);
    const Map map(formats::cell_bounds(blocked, cell), formats::mask_walls(blocked, cell));
    seconds.push_back(processor_seconds() - began);
    if (map.walls().empty()) throw std::runtime_error("bench: a map without walls");
  }
  return {{.name = "reading random512-10-0, a grid map of 512 × 512 cells",
           .quantity = "processor time, median",
           .unit = "s",
           .ours = quantile(seconds, 0.5),
           .aim = 0.2}};
}

}  // namespace microswarm::bench
