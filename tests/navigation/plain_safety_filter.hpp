// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/prediction/convex_outline.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/navigation/radar/safety_filter.hpp"

namespace microswarm::navigation {

/// SafetyFilter as it is defined: every way against every body at every time.
class PlainSafetyFilter {
 public:
  PlainSafetyFilter(const SafetyFilterParams& params, double speed)
      : params_(params),
        speed_(speed),
        samples_(static_cast<int>(std::ceil(params.horizon / params.step))),
        tracker_(params.tracker),
        velocities_(1),
        outliner_(params.tuning.outline) {
    for (int k = 0; k < params.directions; ++k)
      velocities_.push_back(speed * unit_vector(wrap(2 * pi * k / params.directions)));
  }

  void update(const Observation& observation) {
    tracker_.update(observation, range() + (observation.swarm ? observation.swarm->radius : 0));
  }

  std::optional<Command> filter(const Command& wanted, const EscapeStart& start,
                                const Snapshot& world, double tick) {
    start_ = start;
    look_at_bodies(world);
    std::optional<Command> instead;
    if (!threats_.empty() || !nonconvex_.empty()) {
      gap_now_ = gap(start.position, 0, params_.gap, 0);
      wall_keep_ = std::clamp(world.map().clearance(start.position) - 1e-6, 0.0,
                              start.radius + params_.wall_gap);
      instead = checked(wanted, world.map(), std::max(tick, params_.commitment));
    } else {
      committed_.reset();
    }
    if (!instead) waited_ = 0;
    if (instead && instead->speed == 0) waited_ += tick;
    const Command& driven = instead ? *instead : wanted;
    if (driven.speed > 0) course_ = driven.heading;
    return instead;
  }

 private:
  struct Threat {
    ConvexOutline outline;
    Vec2 velocity;
    double widening = 0, speed = 0;
  };
  struct Committed {
    TwoLegTrajectory trajectory;
    double time = 0;
  };

  double range() const { return 3 * speed_ * (params_.horizon + params_.tuning.max_dead_time); }

  void look_at_bodies(const Snapshot& world) {
    threats_.clear();
    closing_ = 0;
    std::vector<Body> nonconvex;
    const auto bodies = world.moving().bodies();
    const SafetyFilterTuning& tuning = params_.tuning;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Disc extent = enclosing_disc(bodies[i]);
      const double far = distance(extent.centre, start_.position) - extent.radius - start_.radius;
      const TrackedBody motion = tracker_.body(i);
      const double widening = outward_speed(bodies[i], motion);
      const double closing = speed_ + norm(motion.velocity) + params_.gap_rate;
      const double ahead = start_.time - tracker_.seen();
      if (far > range() ||
          far > params_.gap + closing * (params_.horizon + ahead) + widening * tuning.growth_time)
        continue;
      Threat met{{}, motion.velocity, widening, widening + norm(motion.velocity)};
      outliner_.take(bodies[i], met.outline);
      if (outliner_.misleads(met.outline, std::array{start_.position})) {
        nonconvex.push_back(bodies[i]);
        const Disc reach{start_.position,
                         start_.radius + speed_ * (tuning.max_dead_time + tuning.growth_time)};
        closing_ = std::max(
            closing_, tracker_.outline_speed_within(i, bodies[i], reach) + norm(motion.velocity));
        continue;
      }
      met.outline.centre = motion.centre_after(ahead);
      threats_.push_back(std::move(met));
    }
    nonconvex_ = BodySet(std::move(nonconvex));
  }

  double gap(Vec2 p, double t, double limit, double error_rate) const {
    double least = limit;
    const double since = start_.time - tracker_.seen();
    for (const Threat& met : threats_) {
      const double touch = start_.radius +
                           met.widening * std::min(params_.tuning.growth_time, since + t) +
                           std::min(error_rate, met.speed) * t;
      least = std::min(
          least, met.outline.distance_at(p - (met.outline.centre + t * met.velocity)) - touch);
    }
    if (nonconvex_.empty()) return least;
    const double touch = start_.radius + closing_ * std::min(params_.tuning.growth_time, since) +
                         std::min(error_rate, closing_) * t;
    return std::min(least, nonconvex_.clearance(p, touch + limit) - touch);
  }

  template <class Visit>
  void follow(const TwoLegTrajectory& trajectory, Visit&& visit) const {
    for (int s = 1; s <= samples_; ++s) {
      const double t = s * params_.step;
      if (t - params_.step < trajectory.until && trajectory.until < t)
        if (!visit(trajectory.until, start_.position + trajectory.at(trajectory.until))) return;
      if (!visit(t, start_.position + trajectory.at(t))) return;
    }
  }

  bool is_free(const Map& map, const TwoLegTrajectory& trajectory) const {
    bool free = true;
    follow(trajectory, [&, last = start_.position](double t, Vec2 p) mutable {
      const double required = std::min(params_.gap, gap_now_ + params_.tuning.recovery_rate * t);
      const Vec2 from = std::exchange(last, p);
      free = gap(p, t, required + 1, params_.gap_rate) >= required &&
             (p == from || map.is_free(Segment{from, p}, wall_keep_));
      return free;
    });
    return free;
  }

  EscapeOutcome outcome(const Map& map, const TwoLegTrajectory& trajectory) const {
    const SafetyFilterTuning& tuning = params_.tuning;
    EscapeOutcome out{.until_contact = 0, .least = tuning.counted_gap, .last = 0};
    bool touched = false;
    follow(trajectory, [&, last = start_.position](double t, Vec2 p) mutable {
      const Vec2 from = std::exchange(last, p);
      if (p != from && !map.is_free(Segment{from, p}, wall_keep_)) return false;
      out.last = gap(p, t, tuning.counted_gap, 0);
      out.least = std::min(out.least, out.last);
      touched = touched || out.last < tuning.contact_gap + tuning.contact_gap_rate * t;
      if (!touched) out.until_contact = t;
      return true;
    });
    return out;
  }

  std::optional<Command> checked(const Command& wanted, const Map& map, double lasting) {
    std::optional<Command> instead;
    if (escapes(map, wanted, lasting) < 1) {
      instead = nearest_safe(map, wanted, lasting);
      if (!instead) return best_manoeuvre(map);
    }
    committed_.reset();
    return instead;
  }

  std::ptrdiff_t escapes(const Map& map, const Command& command, double lasting) const {
    const Vec2 begin = command.speed * unit_vector(command.heading);
    return std::count_if(velocities_.begin(), velocities_.end(), [&](Vec2 v) {
      return is_free(map, {begin, lasting, v});
    });
  }

  std::optional<Command> nearest_safe(const Map& map, const Command& wanted, double lasting) {
    using Choice = std::pair<std::pair<double, double>, Command>;  // turn, heading
    const double course = course_.value_or(wanted.heading);
    std::vector<Choice> choices{
        {{0.5 * pi + params_.tuning.impatience * waited_, wanted.heading}, {wanted.heading, 0}}};
    const int count = params_.tuning.refinement * params_.directions;
    for (int k = 0; k < count; ++k) {
      const double heading = wrap(wanted.heading + 2 * pi * k / count);
      const double turn =
          (1 + 1e-6) * turn_between(heading, wanted.heading) + turn_between(heading, course);
      choices.push_back({{turn, heading}, {heading, speed_}});
    }
    std::sort(choices.begin(), choices.end(),
              [](const Choice& a, const Choice& b) { return a.first < b.first; });
    for (const auto& [order, command] : choices)
      if (escapes(map, command, lasting) >= params_.tuning.min_escapes) return command;
    return std::nullopt;
  }

  std::vector<TwoLegTrajectory> manoeuvres() const {
    const SafetyFilterTuning& tuning = params_.tuning;
    std::vector<TwoLegTrajectory> trajectories;
    for (const Vec2 v : velocities_) trajectories.push_back({{}, 0, v});
    for (const Vec2 v : velocities_) {
      for (const double t : tuning.hold_times) trajectories.push_back({{}, t, v});
      for (const double t : tuning.run_times) trajectories.push_back({v, t, {}});
    }
    for (std::size_t i = 1; i < velocities_.size(); i += 2)
      for (std::size_t j = 1; j < velocities_.size(); j += 2)
        for (const double t : tuning.turn_times)
          if (i != j) trajectories.push_back({velocities_[i], t, velocities_[j]});
    return trajectories;
  }

  Command best_manoeuvre(const Map& map) {
    const SafetyFilterTuning& tuning = params_.tuning;
    EscapeOutcome best{-1, -std::numeric_limits<double>::infinity(), 0};
    TwoLegTrajectory chosen;
    const auto consider = [&](const TwoLegTrajectory& trajectory) {
      const EscapeOutcome o = outcome(map, trajectory);
      if (o.until_contact != best.until_contact ? o.until_contact < best.until_contact
                                                : o.score() <= best.score() + tuning.gap_tolerance)
        return;
      best = o;
      chosen = trajectory;
    };
    if (committed_) {
      const double until = committed_->trajectory.until - (start_.time - committed_->time);
      consider({committed_->trajectory.first, std::max(until, 0.0), committed_->trajectory.second});
      best.until_contact =
          std::min(best.until_contact + tuning.switch_time, samples_ * params_.step);
      best.least += tuning.switch_gap;
      best.last += tuning.switch_gap;
    }
    for (const TwoLegTrajectory& trajectory : manoeuvres()) consider(trajectory);
    committed_ = Committed{chosen, start_.time};
    const Vec2 begin = chosen.until > 0 ? chosen.first : chosen.second;
    const double speed = norm(begin);
    return {speed > 0 ? heading_along(begin) : 0, speed};
  }

  SafetyFilterParams params_;
  double speed_;
  int samples_;
  ObstacleTracker tracker_;
  std::vector<Vec2> velocities_;
  std::optional<Committed> committed_;
  std::optional<double> course_;
  double waited_ = 0;
  EscapeStart start_;
  double wall_keep_ = 0;
  double gap_now_ = 0;
  ConvexOutliner outliner_;
  std::vector<Threat> threats_;
  BodySet nonconvex_;
  double closing_ = 0;
};

}  // namespace microswarm::navigation
