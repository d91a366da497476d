// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/global_input/global_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_set>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/heap_entry.hpp"
#include "microswarm/planning/exact/distance_field.hpp"
#include "microswarm/planning/global_input/global_rrt.hpp"
#include "microswarm/planning/global_input/global_separation.hpp"

namespace microswarm::planning {
namespace {

constexpr double round_growth = 1.3;
constexpr double cell_of_tolerance = 2.25;
constexpr double finest_of_cell = 0.7;   // a round's hypercubes are this to 1.4 times the cell
constexpr double finer = 0.8;            // when a round found nothing new any more
constexpr double finest_of_step = 1e-3;  // nothing new however fine: there is nothing more
constexpr int max_search_rounds = 10'000;
constexpr double still_of_step = 0.002;  // a shorter move is none
constexpr double met_of_step = 0.002;    // robots nearer than that have met

using HeldPlaces = std::span<const PointF>;

/// An input held for some steps.
struct Held {
  std::uint8_t input = 0;
  std::uint16_t steps = 0;
};

struct Node {
  std::uint32_t parent = 0;
  Held held;
};

/// Data shared by all rounds.
struct Problem {
  const Map& map;
  RobotStepper stepper;
  std::vector<PointF> moves;
  std::vector<PointF> goals;
  GlobalSearchParams params;
  std::size_t n;
  int max_steps;

  PointF moved(PointF p, PointF move) const {
    if (stepper.faces().near(p).empty()) return {p.x + move.x, p.y + move.y};
    return stepper.moved(p, move, params.contact);
  }
  std::vector<PointF> placed(std::span<const Vec2> places) const {
    std::vector<PointF> c(n);
    for (std::size_t i = 0; i < n; ++i) c[i] = stepper.relative(places[i]);
    return c;
  }
  double worst(HeldPlaces c) const {
    float square = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const PointF e{goals[i].x - c[i].x, goals[i].y - c[i].y};
      square = std::max(square, e.x * e.x + e.y * e.y);
    }
    return std::sqrt(static_cast<double>(square));
  }
  /// Have two robots met whose goals no place serves both? The same inputs never part them again.
  bool is_dead(HeldPlaces c) const {
    const auto near = static_cast<float>(met_of_step * params.robostep);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (std::abs(c[i].x - c[j].x) < near && std::abs(c[i].y - c[j].y) < near &&
            distance(position(goals[i]), position(goals[j])) > 2 * params.goal_tolerance)
          return true;
    return false;
  }
  Vec2 position(PointF p) const {
    return map.bounds().centre() + Vec2{static_cast<double>(p.x), static_cast<double>(p.y)};
  }
  /// Error of the robots' relative positions, plus the common distance to move: straight, or with
  /// `fields` the mean of their path lengths around the walls.
  double cost(HeldPlaces c, std::span<DistanceField> fields) const {
    Vec2 sum;
    double squares = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 e{static_cast<double>(goals[i].x - c[i].x),
                   static_cast<double>(goals[i].y - c[i].y)};
      sum += e;
      squares += squared_norm(e);
    }
    const double count = static_cast<double>(n);
    const Vec2 mean = sum / count;
    const double formation = std::sqrt(std::max(0.0, squares / count - squared_norm(mean)));
    if (fields.empty()) return formation + params.travel_weight * norm(mean);
    double travel = 0;
    for (std::size_t i = 0; i < n; ++i) travel += fields[i].estimate(position(c[i]));
    return formation + params.travel_weight * travel / count;
  }
};

/// One search from the start, with its own hypercubes.
class Round {
 public:
  Round(const Problem& problem, std::span<DistanceField> fields, HeldPlaces start, double cell,
        Rng& rng, PlanCounts& counts)
      : problem_(problem),
        separation_(problem.stepper, problem.params.contact, problem.params.separation),
        fields_(fields),
        rng_(rng),
        counts_(counts),
        per_cell_(static_cast<float>(1 / cell)),
        offset_(problem.n),
        before_(problem.n),
        now_(problem.n) {
    for (PointF& p : offset_)
      p = {static_cast<float>(rng.uniform()), static_cast<float>(rng.uniform())};
    add(start, 0, {});
  }

  enum class End { solved, exhausted, nodes, told };
  End run(std::size_t max_nodes, const Stop& stop) {
    while (!is_solved()) {
      if (open_.empty()) return End::exhausted;
      if (nodes_.size() >= max_nodes) return End::nodes;
      if (stop()) return End::told;
      const std::uint32_t from = open_.top().node;
      open_.pop();
      ++counts_.iterations;
      for (std::size_t a = 0; a < problem_.moves.size() && !is_solved(); ++a) hold(from, a);
    }
    return End::solved;
  }

  double worst() const { return worst_; }
  std::size_t size() const { return nodes_.size(); }
  /// Inputs from the start to the best node.
  std::vector<Held> inputs() const {
    std::vector<Held> all;
    for (std::uint32_t node = best_; node != 0; node = nodes_[node].parent)
      all.push_back(nodes_[node].held);
    std::ranges::reverse(all);
    return all;
  }

 private:
  HeldPlaces configuration(std::uint32_t node) const {
    return {places_.data() + problem_.n * node, problem_.n};
  }
  bool is_solved() const { return worst_ <= problem_.params.goal_tolerance; }

  // Holds an input until it leads on no more. Three rules place nodes along it:
  // - end: the last configuration before all robots rest or two come too near;
  // - contact: both sides of a step in which the set of hindered robots changes;
  // - doubling: after 1, 2, 4, 8 … steps.
  void hold(std::uint32_t from, std::size_t input) {
    const PointF move = problem_.moves[input];
    std::ranges::copy(configuration(from), now_.begin());
    at_rest_ = 0;
    std::uint64_t hindered_before = 0;
    std::uint16_t doubling = 1;
    const auto node_at = [&](HeldPlaces c, int steps) {
      add(c, from, {static_cast<std::uint8_t>(input), static_cast<std::uint16_t>(steps)});
    };
    for (std::uint16_t steps = 1; steps <= problem_.max_steps; ++steps) {
      const Advance advance = advance_all(move);
      counts_.edge_checks += 1;
      const bool ends = !separation_.holds(before_, now_, move) || !advance.is_moving;
      const bool is_contact = !ends && steps > 1 && advance.hindered != hindered_before;
      if (steps > 1 && (ends || is_contact)) node_at(before_, steps - 1);
      if (ends) return;
      const bool is_doubling = steps == doubling;
      if (is_contact || is_doubling || problem_.worst(now_) <= problem_.params.goal_tolerance)
        node_at(now_, steps);
      if (is_solved()) return;
      if (is_doubling) doubling = static_cast<std::uint16_t>(2 * doubling);
      hindered_before = advance.hindered;
    }
  }

  /// Result of one step of all robots.
  struct Advance {
    std::uint64_t hindered = 0;  ///< a bit for each robot that a wall held back
    bool is_moving = false;
  };

  /// Moves all robots from `now_`, which becomes `before_`. A robot that has come to rest stays.
  Advance advance_all(PointF move) {
    const auto still = static_cast<float>(still_of_step * problem_.params.robostep);
    std::swap(before_, now_);
    Advance out;
    for (std::size_t i = 0; i < problem_.n; ++i) {
      const PointF p = before_[i];
      const PointF q = (at_rest_ >> i & 1) != 0 ? p : problem_.moved(p, move);
      if (q.x == p.x && q.y == p.y) at_rest_ |= std::uint64_t{1} << i;
      now_[i] = q;
      const float lost = std::abs(q.x - p.x - move.x) + std::abs(q.y - p.y - move.y);
      if (lost > still) out.hindered |= std::uint64_t{1} << i;
      out.is_moving |= std::abs(q.x - p.x) + std::abs(q.y - p.y) > still;
    }
    return out;
  }

  void add(HeldPlaces c, std::uint32_t parent, Held held) {
    if (!nodes_.empty() && problem_.is_dead(c)) return;
    const double worst = problem_.worst(c);
    const bool is_best = worst < worst_;
    if (!seen_.insert(hypercube(c)).second && !is_best) return;
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({parent, held});
    places_.insert(places_.end(), c.begin(), c.end());
    ++counts_.samples;
    const double noisy = problem_.cost(c, fields_) * (1 + problem_.params.noise * rng_.uniform());
    open_.push({static_cast<float>(noisy), node});
    if (!is_best) return;
    best_ = node;
    worst_ = worst;
  }

  /// Fingerprint of the hypercube; two that share one only cost a node.
  std::uint64_t hypercube(HeldPlaces c) const {
    std::uint64_t h = 0;
    const auto mix = [&](float v) {
      const auto cell = static_cast<std::int64_t>(std::floor(v));
      h = (h ^ (static_cast<std::uint64_t>(cell) * 0x9e3779b97f4a7c15ULL)) * 0xbf58476d1ce4e5b9ULL;
      h ^= h >> 29;
    };
    for (std::size_t i = 0; i < problem_.n; ++i) {
      mix(c[i].x * per_cell_ + offset_[i].x);
      mix(c[i].y * per_cell_ + offset_[i].y);
    }
    return h;
  }

  const Problem& problem_;
  GlobalSeparation separation_;
  std::span<DistanceField> fields_;
  Rng& rng_;
  PlanCounts& counts_;
  float per_cell_;
  std::vector<PointF> offset_;  // of the hypercubes
  std::vector<PointF> before_, now_;
  std::uint64_t at_rest_ = 0;  // a bit for each robot
  std::vector<Node> nodes_;
  std::vector<PointF> places_;  // n a node
  std::unordered_set<std::uint64_t> seen_;
  std::priority_queue<HeapEntry<float>> open_;
  std::uint32_t best_ = 0;
  double worst_ = std::numeric_limits<double>::infinity();
};

/// The inputs one by one, and where the robots get by them.
GlobalPlan played(const Problem& problem, HeldPlaces start, const std::vector<Held>& inputs) {
  GlobalPlan plan;
  std::vector<PointF> now(start.begin(), start.end());
  const auto note = [&] {
    std::vector<Vec2> places;
    for (std::size_t i = 0; i < problem.n; ++i) places.push_back(problem.position(now[i]));
    plan.configurations.push_back(places);
  };
  note();
  for (const Held held : inputs) {
    const PointF move = problem.moves[held.input];
    for (int k = 0; k < held.steps; ++k) {
      for (std::size_t i = 0; i < problem.n; ++i) now[i] = problem.moved(now[i], move);
      plan.inputs.push_back({static_cast<double>(move.x), static_cast<double>(move.y)});
      note();
    }
  }
  plan.worst = problem.worst(now);
  return plan;
}

Problem make_problem(const Map& map, std::span<const Vec2> starts, std::span<const Vec2> goals,
                     const GlobalSearchParams& params) {
  const Box& bounds = map.bounds();
  const double far = 4 * (bounds.width() + bounds.height()) / params.robostep;
  Problem problem{map,
                  input_stepper(map, params.robostep),
                  input_moves(params.directions, params.robostep),
                  {},
                  params,
                  starts.size(),
                  static_cast<int>(std::clamp(far, 1.0, 30'000.0))};
  for (const Vec2 goal : goals) problem.goals.push_back(problem.stepper.relative(goal));
  return problem;
}

}  // namespace

GlobalSearch global_search(const Map& map, std::span<const Vec2> starts,
                           std::span<const Vec2> goals, const GlobalSearchParams& params, Rng& rng,
                           const Stop& stop) {
  check_robots(starts, goals);
  if (goals.empty()) throw InputError("goals: none given");
  const Problem problem = make_problem(map, starts, goals, params);
  GlobalSearch found;
  found.plan.worst = std::numeric_limits<double>::infinity();
  const std::optional<Status> fault = robots_fault(map, starts, goals, params.goal_tolerance,
                                                   problem.stepper.guard(), params.separation);
  if (fault) {
    found.plan.status = *fault;
    return found;
  }
  const std::vector<PointF> start = problem.placed(starts);
  const auto max_nodes = static_cast<std::uint64_t>(params.max_nodes);
  double round_nodes = params.round_nodes;
  double cell = params.cell > 0 ? params.cell : cell_of_tolerance * params.goal_tolerance;
  std::vector<DistanceField> fields;
  Round::End end = Round::End::nodes;
  while (found.rounds < max_search_rounds && found.counts.samples < max_nodes) {
    ++found.rounds;
    const double round_cell = cell * rng.uniform(finest_of_cell, 2 * finest_of_cell);
    const bool goes_around = found.rounds % 2 == 0;
    if (goes_around && fields.empty())
      for (const Vec2 goal : goals)
        fields.emplace_back(DistanceField::over(map, goal)).stop_with(stop);
    const auto used = goes_around ? std::span<DistanceField>(fields) : std::span<DistanceField>();
    Round round(problem, used, start, round_cell, rng, found.counts);
    const double left = static_cast<double>(max_nodes - found.counts.samples) + 1;
    end = round.run(static_cast<std::size_t>(std::min(round_nodes, left)), stop);
    if (round.worst() < found.plan.worst) found.plan = played(problem, start, round.inputs());
    if (end == Round::End::solved || end == Round::End::told) break;
    round_nodes *= round_growth;
    if (end != Round::End::exhausted) continue;
    cell *= finer;
    if (cell < finest_of_step * params.robostep) break;
  }
  found.plan.status = Status::node_limit;
  if (end == Round::End::solved) found.plan.status = Status::solved;
  if (end == Round::End::told) found.plan.status = stop.status().value_or(Status::time_limit);
  return found;
}

}  // namespace microswarm::planning
