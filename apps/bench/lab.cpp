// SPDX-License-Identifier: Apache-2.0
#include "bench/lab.hpp"

#include <atomic>
#include <chrono>
#include <thread>

#include "bench/lab_client.hpp"
#include "bench/running_lab.hpp"
#include "microswarm/core/maths/statistics.hpp"

namespace microswarm::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

constexpr int crowd_size = 1024;
constexpr int clients = 32;
constexpr double ticks_a_second = 30;  ///< of the clock on the wall, and so of frames

double since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

/// Messages that clients received while a session played.
struct Watched {
  double share = 0;    ///< of a core, for the server beside the simulation
  double slowest = 0;  ///< frames a second of the client with the fewest
  double bytes_a_frame = 0;
};

std::uint64_t frame_number(const std::string& frame) {
  return Json::from_cbor(frame)["number"].get<std::uint64_t>();
}

/// CPU time of the simulation alone from one frame to another [s].
double simulation_time(const fs::path& file, const std::vector<std::string>& settings,
                       std::uint64_t from, std::uint64_t to) {
  const auto session = experiment::open_session(file, {settings, ""});
  double began = 0;
  for (std::uint64_t k = 0; k <= to && session->step(); ++k)
    if (k == from) began = cpu_time(RUSAGE_THREAD);
  return cpu_time(RUSAGE_THREAD) - began;
}

Watched watch(const fs::path& scenarios, int watchers, double duration) {
  const fs::path file = scenarios / "papers/gather/larger_vascular_network.yaml";
  const std::vector<std::string> settings{"robots.count=" + std::to_string(crowd_size),
                                          "navigator.tree.nodes=10000"};
  const RunningLab lab({.folders = {scenarios}});
  const auto number = open_lab_session(lab.url(), {{"file", file}, {"settings", settings}});
  LabClient first(lab.url(), number);
  first.ask({{"do", "step"}});  // plans
  first.next("answer");
  const double tick = experiment::open_session(file, {settings, ""})->scenario().tick;
  first.ask({{"do", "speed"}, {"number", tick * ticks_a_second}});
  first.ask({{"do", "play"}});
  const std::uint64_t begin = frame_number(first.next("frame"));

  std::atomic<double> others = 0;  // CPU time of the clients
  std::atomic<std::uint64_t> bytes = 0, frames = 0, fewest = UINT64_MAX, end = begin;
  const double cpu = cpu_time(RUSAGE_SELF);
  const auto began = Clock::now();
  const auto receive = [&](LabClient& client) {
    const double own = cpu_time(RUSAGE_THREAD);
    std::uint64_t count = 0;
    std::string last;
    while (since(began) < duration) {
      last = client.next("frame");
      bytes += last.size();
      ++count;
    }
    frames += count;
    for (auto least = fewest.load();
         count < least && !fewest.compare_exchange_weak(least, count);) {
    }
    end = frame_number(last);
    others = others + cpu_time(RUSAGE_THREAD) - own;
  };
  {
    std::vector<std::jthread> threads;
    for (int k = 1; k < watchers; ++k)
      threads.emplace_back([&] {
        LabClient client(lab.url(), number);
        receive(client);
      });
    receive(first);
  }
  const double took = since(began);
  const double all = cpu_time(RUSAGE_SELF) - cpu;
  return {.share = (all - others - simulation_time(file, settings, begin, end)) / took,
          .slowest = static_cast<double>(fewest) / took,
          .bytes_a_frame = static_cast<double>(bytes) / static_cast<double>(frames)};
}

/// From the start of the server to the first frame at a client [s].
double first_frame(const fs::path& scenarios) {
  const auto began = Clock::now();
  const RunningLab lab({.folders = {scenarios}});
  const auto file = scenarios / "papers/radar/twelve.yaml";
  LabClient client(lab.url(), open_lab_session(lab.url(), {{"file", file}}));
  client.next("frame");
  return since(began);
}

/// From a changed goal to the message that has it, while the session plays: 99th percentile [s].
double change_time(const fs::path& scenarios, int changes, const Stop& stop) {
  const RunningLab lab({.folders = {scenarios}});
  const auto file = scenarios / "papers/radar/twelve.yaml";
  LabClient client(lab.url(), open_lab_session(lab.url(), {{"file", file}}));
  client.ask({{"do", "play"}});
  std::vector<double> times;
  for (int k = 0; k < changes && !stop(); ++k) {
    client.next("frame");
    const auto began = Clock::now();
    const std::string goal = "[" + std::to_string(4000 + 10 * (k % 2)) + ", 1200]";
    client.ask({{"do", "set"}, {"key", "goal_um"}, {"value", goal}});
    client.next("scenario");
    times.push_back(since(began));
  }
  return times.empty() ? 0 : quantile(times, 0.99);
}

}  // namespace

std::vector<report::BenchRow> lab(const fs::path& scenarios, bool quick, const Stop& stop) {
  const double duration = quick ? 3 : 15;
  const Watched one = watch(scenarios, 1, duration);
  if (stop()) return {};
  const Watched many = watch(scenarios, clients, duration);
  const std::string crowd = std::to_string(crowd_size) + " robots, 30 frames/s";
  const std::string at_once = crowd + ", " + std::to_string(clients) + " clients";
  std::vector<report::BenchRow> rows{
      {.name = crowd, .quantity = "bytes a frame", .unit = "B", .ours = one.bytes_a_frame},
      {.name = crowd,
       .quantity = "share of a core beside the simulation",
       .unit = "%",
       .ours = 100 * one.share,
       .aim = 10},
      {.name = at_once,
       .quantity = "frames a second of the slowest",
       .unit = "1/s",
       .ours = many.slowest,
       .aim = 28,
       .at_most = false},
      {.name = at_once,
       .quantity = "share of a core beside the simulation",
       .unit = "%",
       .ours = 100 * many.share},
      {.name = "server",
       .quantity = "start to the first frame",
       .unit = "ms",
       .ours = 1000 * first_frame(scenarios),
       .aim = 1000},
      {.name = "server",
       .quantity = "change to its message, p99",
       .unit = "ms",
       .ours = 1000 * change_time(scenarios, quick ? 50 : 300, stop),
       .aim = 100}};
  if (stop()) return rows;
  for (report::BenchRow& row : lab_in_browser(scenarios.parent_path(), quick))
    rows.push_back(std::move(row));
  return rows;
}

}  // namespace microswarm::bench
