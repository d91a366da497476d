// SPDX-License-Identifier: Apache-2.0
#include "bench/bindings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "bench/temporary_folder.hpp"
#include "microswarm.h"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/experiment/session/standalone_navigator.hpp"

namespace microswarm::bench {
namespace {

namespace fs = std::filesystem;
using Clock = Stop::Clock;
/// Times of the steps of each cycle through the observations [µs].
using Cycles = std::vector<std::vector<double>>;

constexpr int cycles_a_turn = 5;

/// Step programs. Each reads a file of observations, with equally many numbers in every line, and
/// prints the time of each step, a cycle a line.
constexpr const char* python_steps = R"(
import sys, time
import numpy as np
import microswarm as ms
file, observations, cycles = sys.argv[1:]
rows = np.loadtxt(observations)
seen = [(float(r[0]), tuple(r[1:5].tolist()), r[5:].reshape(-1, 3).copy()) for r in rows]
now = time.perf_counter_ns
for _ in range(int(cycles)):
    nav = ms.Navigator(file)
    times = []
    for t, swarm, obstacles in seen:
        began = now()
        nav.step(t, swarm=swarm, obstacles=obstacles)
        times.append((now() - began) / 1e3)
    print(*times)
)";

constexpr const char* octave_steps = R"(
given = argv();
file = given{end - 2};
rows = load(given{end - 1});
for cycle = 1:str2double(given{end})
  nav = microswarm.Navigator(file);
  times = zeros(1, size(rows, 1));
  for k = 1:size(rows, 1)
    swarm = rows(k, 2:5);
    obstacles = reshape(rows(k, 6:end), 3, []).';
    began = tic();
    nav.step(rows(k, 1), swarm, obstacles);
    times(k) = double(toc(began)) * 1e6;
  end
  printf('%.3f ', times);
  printf("\n");
end
)";

constexpr const char* python_sweep = R"(
import sys, time
import microswarm as ms
scenario = ms.Scenario.load(sys.argv[1])
ms.sweep(scenario, {"navigator.clearance_um": [45, 46]}, jobs=2)
began = time.perf_counter()
table = ms.sweep(
    scenario,
    {"navigator.clearance_um": list(range(45, 55)), "navigator.extra_clearance_um": list(range(5, 15))},
    trials=int(sys.argv[2]), jobs=2)
print(time.perf_counter() - began, table.rows)
)";
/// A run of the scenario as a camera would see it.
std::vector<experiment::ExternalObservation> observations(const fs::path& scenario) {
  const std::unique_ptr<experiment::Session> session = experiment::open_session(scenario);
  std::vector<experiment::ExternalObservation> all;
  while (session->step()) {
    const experiment::SessionView view = session->view();
    experiment::ExternalObservation seen{.now = view.frame.t, .seen = view.frame.t};
    seen.swarm = {view.frame.pose, view.frame.radius};
    for (const Body& body : view.bodies) seen.obstacles.push_back({.shape = enclosing_disc(body)});
    all.push_back(std::move(seen));
  }
  return all;
}

void write(const fs::path& file, const std::vector<experiment::ExternalObservation>& all) {
  std::ofstream out(file);
  for (const experiment::ExternalObservation& seen : all) {
    const Pose2& pose = seen.swarm->pose;
    out << fmt::format("{} {} {} {} {}", seen.now, pose.position.x, pose.position.y, pose.heading,
                       seen.swarm->radius);
    for (const Body& body : seen.obstacles) {
      const Disc disc = enclosing_disc(body);
      out << fmt::format(" {} {} {}", disc.centre.x, disc.centre.y, disc.radius);
    }
    out << "\n";
  }
}

double us_since(Clock::time_point began) { return 1e6 * seconds_since(began); }

void step_in_cpp(const fs::path& scenario, const std::vector<experiment::ExternalObservation>& all,
                 Cycles& cycles) {
  for (int cycle = 0; cycle < cycles_a_turn; ++cycle) {
    experiment::StandaloneNavigator navigator(experiment::open_experiment(scenario));
    std::vector<double>& times = cycles.emplace_back();
    for (const experiment::ExternalObservation& seen : all) {
      const auto began = Clock::now();
      navigator.step(seen);
      times.push_back(us_since(began));
    }
  }
}

ms_observation plain(const experiment::ExternalObservation& seen,
                     std::vector<ms_obstacle>& obstacles) {
  obstacles.clear();
  for (const Body& body : seen.obstacles) {
    const Disc disc = enclosing_disc(body);
    obstacles.push_back({.x_um = disc.centre.x, .y_um = disc.centre.y, .radius_um = disc.radius});
  }
  const Pose2& pose = seen.swarm->pose;
  return {.now_s = seen.now,
          .seen_s = seen.seen,
          .has_swarm = 1,
          .x_um = pose.position.x,
          .y_um = pose.position.y,
          .heading_rad = pose.heading,
          .radius_um = seen.swarm->radius,
          .obstacles = obstacles.data(),
          .obstacle_count = obstacles.size()};
}

void step_in_c(const fs::path& scenario, const std::vector<experiment::ExternalObservation>& all,
               Cycles& cycles) {
  std::vector<ms_obstacle> obstacles;
  for (int cycle = 0; cycle < cycles_a_turn; ++cycle) {
    std::uint64_t navigator = 0;
    if (ms_navigator_open(scenario.c_str(), nullptr, 0, &navigator) != MS_OK)
      throw std::runtime_error(std::string("bench: ") + ms_error_text());
    std::vector<double>& times = cycles.emplace_back();
    for (const experiment::ExternalObservation& given : all) {
      const ms_observation seen = plain(given, obstacles);
      ms_command command;
      const auto began = Clock::now();
      ms_navigator_step(navigator, &seen, &command);
      times.push_back(us_since(began));
    }
    ms_close(navigator);
  }
}

/// The lines of numbers that a program prints; none if it fails.
Cycles printed_by(const std::string& command) {
  Cycles lines;
  std::FILE* out = ::popen((command + " 2>/dev/null").c_str(), "r");
  if (!out) return lines;
  std::string text;
  std::array<char, 65536> part{};
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), out))
    text.append(part.data(), n);
  if (::pclose(out) != 0) return lines;
  std::istringstream rest(text);
  for (std::string line; std::getline(rest, line);) {
    std::istringstream numbers(line);
    std::vector<double>& all = lines.emplace_back();
    for (double number = 0; numbers >> number;) all.push_back(number);
  }
  return lines;
}

void append(Cycles& all, Cycles more) {
  for (std::vector<double>& one : more) all.push_back(std::move(one));
}

std::vector<double> joined(const Cycles& cycles) {
  std::vector<double> all;
  for (const auto& one : cycles) all.insert(all.end(), one.begin(), one.end());
  return all;
}

/// Of each step, the median over the cycles.
std::vector<double> medians(const Cycles& cycles) {
  std::vector<double> all;
  for (std::size_t step = 0; step < cycles.front().size(); ++step) {
    std::vector<double> times;
    for (const auto& one : cycles)
      if (step < one.size()) times.push_back(one[step]);
    all.push_back(quantile(times, 0.5));
  }
  return all;
}

/// Additional time of a step compared with C++: median of the differences.
double more_than(const Cycles& cpp, const Cycles& other) {
  const std::vector<double> plain = medians(cpp);
  std::vector<double> more = medians(other);
  for (std::size_t i = 0; i < more.size() && i < plain.size(); ++i) more[i] -= plain[i];
  return quantile(more, 0.5);
}

struct Language {
  const char* name;
  std::optional<double> aim;  ///< of what a call takes longer than in C++ [µs]
  Cycles cycles;
};

std::vector<report::BenchRow> steps(const fs::path& scenario, const fs::path& folder,
                                    const fs::path& program, bool quick, const Stop& stop) {
  const std::vector<experiment::ExternalObservation> seen = observations(scenario);
  const fs::path file = folder / "observations.txt";
  write(file, seen);
  const fs::path build = program.parent_path().parent_path();
  const std::string given =
      fmt::format("'{}' '{}' {}", scenario.string(), file.string(), cycles_a_turn);
  const std::string python = fmt::format("PYTHONPATH='{}' /usr/bin/python3 -c '{}' {}",
                                         (build / "python").string(), python_steps, given);
  const fs::path script = folder / "steps.m";
  std::ofstream(script) << octave_steps;
  const std::string octave = fmt::format(
      "octave-cli --no-gui --norc --no-history --path '{}/bindings/matlab' --path '{}' "
      "'{}' {}",
      MICROSWARM_SOURCE_DIR, (build / "matlab").string(), script.string(), given);
  std::array<Language, 4> all{Language{"C++", {}, {}}, Language{"C", 0.2, {}},
                              Language{"Python", 3, {}}, Language{"Octave", {}, {}}};
  const std::size_t calls = quick ? 2'000 : 20'000;
  for (std::size_t done = 0; done < calls && !stop(); done += cycles_a_turn * seen.size()) {
    step_in_cpp(scenario, seen, all[0].cycles);
    step_in_c(scenario, seen, all[1].cycles);
    append(all[2].cycles, printed_by(python));
    append(all[3].cycles, printed_by(octave));
  }
  std::vector<report::BenchRow> rows;
  const auto add = [&](const Language& language, const std::string& quantity, double us,
                       std::optional<double> aim = {}) {
    rows.push_back(
        {.name = fmt::format("first_flight, {} steps", language.cycles.size() * seen.size()),
         .quantity = fmt::format("{}: {}", language.name, quantity),
         .unit = "µs",
         .ours = us,
         .aim = aim});
  };
  for (const Language& language : all) {
    if (language.cycles.empty()) continue;
    const std::vector<double> times = joined(language.cycles);
    add(language, "a step of the navigator, p50", quantile(times, 0.5));
    add(language, "a step of the navigator, p99", quantile(times, 0.99));
    if (&language != all.data())
      add(language, "a step more than in C++, p50", more_than(all[0].cycles, language.cycles),
          language.aim);
  }
  return rows;
}

/// Seconds of the same sweep on two threads from Python and by the program, by turns.
std::vector<report::BenchRow> sweeps(const fs::path& scenario, const fs::path& folder,
                                     const fs::path& program, bool quick, const Stop& stop) {
  const int trials = quick ? 5 : 100;
  const fs::path file = folder / "sweep.yaml";
  std::ofstream(file) << fmt::format(
      "name: bench\nscenario: {}\ngrid:\n"
      "  - key: navigator.clearance_um\n    values: [45, 46, 47, 48, 49, 50, 51, 52, 53, 54]\n"
      "  - key: navigator.extra_clearance_um\n    values: [5, 6, 7, 8, 9, 10, 11, 12, 13, 14]\n"
      "trials: {}\n",
      fs::absolute(scenario).string(), trials);
  const fs::path build = program.parent_path().parent_path();
  const std::string python =
      fmt::format("PYTHONPATH='{}' /usr/bin/python3 -c '{}' '{}' {}", (build / "python").string(),
                  python_sweep, scenario.string(), trials);
  const std::string tool =
      fmt::format("{} sweep '{}' --out '{}' --jobs 2 >/dev/null", program.string(), file.string(),
                  (folder / "sweep.db").string());
  std::vector<double> ours, peer;
  for (int turn = 0; turn < (quick ? 3 : 2) && !stop(); ++turn) {
    const Cycles printed = printed_by(python);
    if (printed.empty() || printed[0].size() != 2) return {};
    ours.push_back(printed[0][0]);
    fs::remove(folder / "sweep.db");
    const auto began = Clock::now();
    printed_by(tool);
    peer.push_back(seconds_since(began));
  }
  if (ours.empty()) return {};
  return {{.name = fmt::format("sweep of {} trials", 100 * trials),
           .quantity = "Python: time beside that of the program",
           .unit = "",
           .ours = quantile(ours, 0.5) / quantile(peer, 0.5),
           .aim = 1.1}};
}

}  // namespace

std::vector<report::BenchRow> bindings(const fs::path& scenarios, const fs::path& program,
                                       bool quick, const Stop& stop) {
  const TemporaryFolder folder;
  const fs::path scenario = fs::absolute(scenarios / "first_flight.yaml");
  std::vector<report::BenchRow> rows = steps(scenario, folder.path(), program, quick, stop);
  for (report::BenchRow& row : sweeps(scenario, folder.path(), program, quick, stop))
    rows.push_back(std::move(row));
  return rows;
}

}  // namespace microswarm::bench
