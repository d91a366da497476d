// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/core/angles.hpp"

namespace microswarm {
namespace {

constexpr std::size_t mark_interval = RolloutPlan::mark_interval;
constexpr std::array<std::size_t, 5> lengths{5, 10, 20, 40, 80};  // of a change [steps]
/// Enough to choose the base when robots have strayed: the plan will be off again soon.
constexpr std::size_t places_when_strayed = 64;

/// Crowds that are thinned out start from cells of this many steps.
constexpr double finest_cell = 0.25;

}  // namespace

RolloutGatherer::RolloutGatherer(const AggregationMap& ground, const RobotStepper& stepper,
                                 const AggregationParams& params, Rng rng)
    : simulator_(ground, stepper, params),
      params_(params.rollout),
      stepper_(&stepper),
      rng_(rng),
      ground_(&ground),
      base_(ground, params),
      expected_(Robots{}) {}

std::optional<Vec2> RolloutGatherer::next(const Robots& robots, const Stop& stop) {
  if (robots.size() == 0) return std::nullopt;
  const double work_before = simulator_.work();
  const bool begins = robots.size() != expected_.size();
  look(robots, begins || done_ == steps());
  if (mean_way_ < simulator_.params().sigma) return std::nullopt;
  if (begins) {
    start(robots);
  } else if (leads() && (done_ == steps() || !on_plan(robots))) {
    plan_anew(robots);
  }
  if (!leads()) return base_.next(robots);
  think(params_.budget - (simulator_.work() - work_before), stop);
  ++made_;
  const Vec2 move = plan_.moves[done_++];
  if (done_ % mark_interval == 0) expected_.join();
  stepper_->step(expected_.places(), move, ContactRule::stop);
  return move;
}

// Not without a plan, nor when robots are so unlike those of the simulation that it would take
// twice as long as its base should: then a policy that looks at them at every step is better.
bool RolloutGatherer::leads() const {
  constexpr std::size_t most_bases = 2;
  return steps() > 0 && made_ + steps_left() <= most_bases * base_steps_;
}

// The mean way shrinks by a step a move at best.
void RolloutGatherer::look(const Robots& robots, bool always) {
  if (!always && --unmeasured_ > 0) return;
  const AggregationParams& p = simulator_.params();
  mean_way_ = simulator_.mean_way(Crowd(robots));
  unmeasured_ = static_cast<int>(std::clamp((mean_way_ - p.sigma) / p.step, 1.0, 1e6));
}

bool RolloutGatherer::on_plan(const Robots& robots) const {
  double off = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const PointF p = expected_.place_of(i);
    off += distance(Vec2{robots.x[i], robots.y[i]}, Vec2{p.x, p.y});
  }
  return off <= params_.stray * simulator_.params().step * static_cast<double>(robots.size());
}

std::optional<RolloutDraft> RolloutGatherer::simulated(const Robots& robots, Aggregation method,
                                                       std::size_t most) {
  RolloutDraft draft{Crowd(robots)};
  draft.keeps_marks = true;
  if (!simulator_.finish(draft, method, most)) return std::nullopt;
  return draft;
}

// The base: the shorter one of both policies.
void RolloutGatherer::start(const Robots& robots) {
  expected_ = Crowd(robots);
  done_ = 0;
  plan_ = {};
  const auto longest = static_cast<std::size_t>(params_.most_steps);
  for (const Aggregation method : {Aggregation::divide_and_conquer, Aggregation::heuristic}) {
    const std::size_t most = plan_.moves.empty() ? longest : steps();
    auto draft = simulated(robots, method, most);
    if (!draft) continue;
    plan_.moves = std::move(draft->moves);
    plan_.marks = std::move(draft->marks);
    AggregationParams base = simulator_.params();
    base.method = method;
    base_ = Gatherer(*ground_, base);
  }
  made_ = 0;
  base_steps_ = steps();
  grown_.reset();
  head_start_ = 0;
  looks_ahead_ = params_.candidates > 0;
}

void RolloutGatherer::plan_anew(const Robots& robots) {
  ++replans_;
  Crowd some(robots);
  some.thin_out(places_when_strayed, finest_cell * simulator_.params().step);
  const std::span<const Vec2> rest = std::span(plan_.moves).subspan(done_);
  auto most = static_cast<std::size_t>(params_.most_steps);
  std::vector<Vec2> best;
  for (const bool goes_on : {true, false}) {
    for (const Aggregation method : {Aggregation::heuristic, Aggregation::divide_and_conquer}) {
      RolloutDraft draft{some};
      if (goes_on) simulator_.follow(draft, rest, most);
      if (!simulator_.finish(draft, method, most)) continue;
      best = std::move(draft.moves);
      most = best.size();
    }
  }
  expected_ = Crowd(robots);
  done_ = 0;
  RolloutDraft draft{Crowd(robots)};
  draft.keeps_marks = true;
  simulator_.follow(draft, best, best.size());
  plan_ = {};
  if (best.empty() || !simulator_.finish(draft, Aggregation::heuristic,
                                         static_cast<std::size_t>(params_.most_steps))) {
    start(robots);
    return;
  }
  plan_.moves = std::move(draft.moves);
  plan_.marks = std::move(draft.marks);
  grown_.reset();
}

void RolloutGatherer::think(double budget, const Stop& stop) {
  const double begun = simulator_.work();
  if (params_.most_work > 0) budget = std::min(budget, params_.most_work - thought_);
  const auto may_go_on = [&] { return simulator_.work() - begun < budget && !stop(); };
  constexpr std::size_t least_left = 2;
  while (steps() >= done_ + least_left && may_go_on()) {
    if (looks_ahead_) {
      looks_ahead_ = grow();
    } else {
      vary();
    }
  }
  thought_ += simulator_.work() - begun;
}

// Grows a plan by looking ahead again and again. It begins a little ahead of the robots; when they
// overtake it, twice as far ahead. True while it should go on.
bool RolloutGatherer::grow() {
  if (!grown_ || grown_->from < done_) {
    const std::size_t from = (done_ + head_start_ + mark_interval - 1) / mark_interval;
    if (from >= plan_.marks.size()) return false;
    head_start_ = 2 * head_start_ + mark_interval;
    grown_ = RolloutDraft{plan_.marks[from], from * mark_interval};
    grown_->keeps_marks = true;
  }
  const std::vector<Vec2> moves = simulator_.look_ahead(grown_->crowd, rng_);
  simulator_.follow(*grown_, moves, steps());
  const bool too_long = grown_->steps() >= steps();
  const bool ends = moves.empty() || simulator_.gathered(grown_->crowd);
  if (!ends && !too_long) return true;
  if (ends && simulator_.finish(*grown_, Aggregation::heuristic, steps()))
    adopt(std::move(*grown_));
  grown_.reset();
  return false;
}

RolloutDraft RolloutGatherer::draft_at(std::size_t step, std::size_t most_places) {
  const std::size_t mark = step / mark_interval;
  RolloutDraft draft{plan_.marks[mark], mark * mark_interval};
  draft.crowd.thin_out(most_places, finest_cell * simulator_.params().step);
  simulator_.follow(draft, std::span(plan_.moves).subspan(draft.from), step);
  return draft;
}

// One thing is done otherwise somewhere; then the plan goes on, or a base policy does.
void RolloutGatherer::vary() {
  RolloutDraft draft =
      draft_at(done_ + rng_.below(steps() - done_), static_cast<std::size_t>(params_.places));
  change(draft);
  if (simulator_.finish(
          draft, rng_.below(2) == 0 ? Aggregation::heuristic : Aggregation::divide_and_conquer,
          steps()))
    verify(draft);
}

void RolloutGatherer::change(RolloutDraft& draft) {
  const std::size_t at = draft.steps();
  const std::size_t length = lengths[rng_.below(lengths.size())];
  const std::size_t most = steps();
  std::size_t goes_on_at = at;
  bool goes_on = rng_.below(3) == 0;
  switch (rng_.below(5)) {
    case 0:  // one leads all the way
      simulator_.lead(draft, rng_.below(draft.crowd.places().size()), most, most);
      break;
    case 1:
      simulator_.lead(draft, rng_.below(draft.crowd.places().size()), length, most);
      break;
    case 2: {  // all in one direction
      const double any = rng_.uniform(0, 2 * pi);
      const double square = pi / 2 * static_cast<double>(rng_.below(4));
      const Vec2 move = simulator_.params().step * unit_vector(rng_.below(2) == 0 ? any : square);
      const std::vector<Vec2> moves(length, move);
      simulator_.follow(draft, moves, most);
      break;
    }
    case 3:  // some moves are left out
      goes_on = true;
      goes_on_at = std::min(most, at + 1 + rng_.below(length));
      break;
    default:  // another policy from here on
      goes_on = false;
  }
  if (goes_on) simulator_.follow(draft, std::span(plan_.moves).subspan(goes_on_at), most);
}

// With all robots.
void RolloutGatherer::verify(const RolloutDraft& draft) {
  RolloutDraft all{plan_.marks[draft.from / mark_interval], draft.from};
  all.keeps_marks = true;
  simulator_.follow(all, draft.moves, steps());
  if (simulator_.finish(all, Aggregation::heuristic, steps())) adopt(std::move(all));
}

void RolloutGatherer::adopt(RolloutDraft&& draft) {
  if (draft.steps() >= steps()) return;
  const auto kept = static_cast<std::ptrdiff_t>(draft.from);
  plan_.moves.erase(plan_.moves.begin() + kept, plan_.moves.end());
  plan_.moves.insert(plan_.moves.end(), draft.moves.begin(), draft.moves.end());
  const auto marks = static_cast<std::ptrdiff_t>(draft.from / mark_interval);
  plan_.marks.erase(plan_.marks.begin() + marks, plan_.marks.end());
  std::move(draft.marks.begin(), draft.marks.end(), std::back_inserter(plan_.marks));
  ++improvements_;
}

}  // namespace microswarm
