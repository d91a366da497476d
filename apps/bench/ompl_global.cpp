// SPDX-License-Identifier: Apache-2.0
#include "bench/ompl_global.hpp"

#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/control/DirectedControlSampler.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/spaces/DiscreteControlSpace.h>
#include <ompl/util/Console.h>

#include <chrono>
#include <limits>
#include <memory>
#include <vector>

namespace microswarm::bench {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

double* values(ob::State* state) {
  return state->as<ob::RealVectorStateSpace::StateType>()->values;
}
const double* values(const ob::State* state) {
  return state->as<ob::RealVectorStateSpace::StateType>()->values;
}

PointF place(const double* v, std::size_t robot) {
  return {static_cast<float>(v[2 * robot]), static_cast<float>(v[2 * robot + 1])};
}

/// Alg 2 [global], with a count of the created nodes.
class LocalPlanner : public oc::DirectedControlSampler {
 public:
  LocalPlanner(const oc::SpaceInformation* si, const RobotStepper& stepper,
               const planning::GlobalRrtParams& params, std::size_t robots, std::size_t& nodes)
      : oc::DirectedControlSampler(si),
        stepper_(stepper),
        rule_(params.contact),
        moves_(planning::input_moves(params.directions, params.robostep)),
        n_(robots),
        reached_(robots * moves_.size()),
        nodes_(nodes) {}

  unsigned sampleTo(oc::Control* control, const ob::State* source, ob::State* target) override {
    const double* from = values(source);
    double* to = values(target);
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t a = 0; a < moves_.size(); ++a) {
      double sum = 0;
      for (std::size_t i = 0; i < n_; ++i) {
        const PointF p = stepper_.moved(place(from, i), moves_[a], rule_);
        const double dx = static_cast<double>(p.x) - to[2 * i];
        const double dy = static_cast<double>(p.y) - to[2 * i + 1];
        sum += dx * dx + dy * dy;
        reached_[i * moves_.size() + a] = p;
      }
      if (sum >= least) continue;
      least = sum;
      best = a;
    }
    bool is_moving = false;
    for (std::size_t i = 0; i < n_; ++i) {
      const PointF p = reached_[i * moves_.size() + best];
      to[2 * i] = static_cast<double>(p.x);
      to[2 * i + 1] = static_cast<double>(p.y);
      is_moving |= to[2 * i] != from[2 * i] || to[2 * i + 1] != from[2 * i + 1];
    }
    control->as<oc::DiscreteControlSpace::ControlType>()->value = static_cast<int>(best);
    nodes_ += is_moving;
    return is_moving ? 1 : 0;
  }
  unsigned sampleTo(oc::Control* control, const oc::Control*, const ob::State* source,
                    ob::State* target) override {
    return sampleTo(control, source, target);
  }

 private:
  const RobotStepper& stepper_;
  ContactRule rule_;
  std::vector<PointF> moves_;
  std::size_t n_;
  std::vector<PointF> reached_;
  std::size_t& nodes_;
};

class NoGoal : public ob::Goal {
 public:
  explicit NoGoal(const ob::SpaceInformationPtr& si) : ob::Goal(si) {}
  bool isSatisfied(const ob::State*) const override { return false; }
  bool isSatisfied(const ob::State*, double* distance) const override {
    *distance = 1;
    return false;
  }
};

std::shared_ptr<ob::RealVectorStateSpace> make_space(const Map& map, std::size_t robots) {
  const auto dimension = static_cast<unsigned>(2 * robots);
  auto space = std::make_shared<ob::RealVectorStateSpace>(dimension);
  ob::RealVectorBounds bounds(dimension);
  const Vec2 half = map.bounds().hi - map.bounds().centre();
  for (unsigned k = 0; k < dimension; ++k) {
    bounds.setLow(k, k % 2 == 0 ? -half.x : -half.y);
    bounds.setHigh(k, k % 2 == 0 ? half.x : half.y);
  }
  space->setBounds(bounds);
  return space;
}

}  // namespace

OmplGrowth grow_ompl(const Map& map, std::span<const Vec2> starts,
                     const planning::GlobalRrtParams& params, std::size_t nodes,
                     double max_seconds) {
  ompl::msg::noOutputHandler();
  const std::size_t n = starts.size();
  const RobotStepper stepper = planning::input_stepper(map, params.robostep);
  std::size_t grown = 1;
  const auto space = make_space(map, n);
  const auto controls = std::make_shared<oc::DiscreteControlSpace>(space, 0, params.directions - 1);
  auto si = std::make_shared<oc::SpaceInformation>(space, controls);
  si->setStateValidityChecker([](const ob::State*) { return true; });
  si->setStatePropagator(
      [](const ob::State*, const oc::Control*, double, ob::State*) {});  // done by the sampler
  si->setMinMaxControlDuration(1, 1);
  si->setPropagationStepSize(1);
  si->setDirectedControlSamplerAllocator([&](const oc::SpaceInformation* info) {
    return std::make_shared<LocalPlanner>(info, stepper, params, n, grown);
  });
  si->setup();
  auto problem = std::make_shared<ob::ProblemDefinition>(si);
  ob::ScopedState<> start(si);
  for (std::size_t i = 0; i < n; ++i) {
    const PointF p = stepper.relative(starts[i]);
    start[static_cast<unsigned>(2 * i)] = static_cast<double>(p.x);
    start[static_cast<unsigned>(2 * i + 1)] = static_cast<double>(p.y);
  }
  problem->addStartState(start);
  problem->setGoal(std::make_shared<NoGoal>(si));
  oc::RRT planner(si);
  planner.setProblemDefinition(problem);
  planner.setup();

  const auto began = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  };
  planner.solve(
      ob::PlannerTerminationCondition([&] { return grown >= nodes || seconds() >= max_seconds; }));
  return {grown, seconds()};
}

}  // namespace microswarm::bench
