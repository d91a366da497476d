// SPDX-License-Identifier: Apache-2.0
#include "bench/ompl_peer.hpp"

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/config.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>

#include <chrono>
#include <memory>
#include <vector>

namespace microswarm::bench {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

Vec2 position(const ob::State* state) {
  const double* v = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {v[0], v[1]};
}

class ExactMotion : public ob::MotionValidator {
 public:
  ExactMotion(const ob::SpaceInformationPtr& si, const Snapshot& world, double clearance)
      : ob::MotionValidator(si), world_(world), clearance_(clearance) {}
  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return world_.is_free(Segment{position(a), position(b)}, clearance_);
  }
  bool checkMotion(const ob::State* a, const ob::State* b,
                   std::pair<ob::State*, double>& last) const override {
    last.second = 0;
    return checkMotion(a, b);
  }

 private:
  const Snapshot& world_;
  double clearance_;
};

ob::SpaceInformationPtr information(const Snapshot& world, double clearance, bool exact) {
  auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0, world.bounds().lo.x);
  bounds.setHigh(0, world.bounds().hi.x);
  bounds.setLow(1, world.bounds().lo.y);
  bounds.setHigh(1, world.bounds().hi.y);
  space->setBounds(bounds);
  auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker(
      [&world, clearance](const ob::State* s) { return world.is_free(position(s), clearance); });
  if (exact) si->setMotionValidator(std::make_shared<ExactMotion>(si, world, clearance));
  si->setup();
  return si;
}

template <class Planner>
std::shared_ptr<Planner> with_range(const ob::SpaceInformationPtr& si, double range) {
  auto planner = std::make_shared<Planner>(si);
  planner->setRange(range);
  return planner;
}

/// The planner as published: neighbours within a radius, not a fixed number.
ob::PlannerPtr fmt_star(const ob::SpaceInformationPtr& si, const OmplQuery& query) {
  auto planner = std::make_shared<og::FMT>(si);
  planner->setNumSamples(query.samples);
  planner->setNearestK(false);
  planner->setRadiusMultiplier(query.radius_factor);
  if (query.free_area > 0) planner->setFreeSpaceVolume(query.free_area);
  return planner;
}

ob::PlannerPtr make(OmplPlanner kind, const ob::SpaceInformationPtr& si, const OmplQuery& query) {
  const double range = query.range;
  switch (kind) {
    case OmplPlanner::rrt_connect:
      return with_range<og::RRTConnect>(si, range);
    case OmplPlanner::rrt_star:
      return with_range<og::RRTstar>(si, range);
    case OmplPlanner::informed_rrt_star:
      return with_range<og::InformedRRTstar>(si, range);
    case OmplPlanner::bit_star:
      return std::make_shared<og::BITstar>(si);
    case OmplPlanner::fmt_star:
      return fmt_star(si, query);
  }
  return {};
}

ob::ScopedState<> state(const ob::SpaceInformationPtr& si, Vec2 p) {
  ob::ScopedState<> s(si);
  s[0] = p.x;
  s[1] = p.y;
  return s;
}

}  // namespace

std::string_view to_text(OmplPlanner planner) {
  switch (planner) {
    case OmplPlanner::rrt_connect:
      return "OMPL RRTConnect";
    case OmplPlanner::rrt_star:
      return "OMPL RRT*";
    case OmplPlanner::informed_rrt_star:
      return "OMPL Informed RRT*";
    case OmplPlanner::bit_star:
      return "OMPL BIT*";
    case OmplPlanner::fmt_star:
      return "OMPL FMT*";
  }
  return {};
}

std::string ompl_version() {
  return std::to_string(OMPL_MAJOR_VERSION) + "." + std::to_string(OMPL_MINOR_VERSION) + "." +
         std::to_string(OMPL_PATCH_VERSION);
}

OmplResult run_ompl(OmplPlanner kind, const OmplQuery& q) {
  ompl::msg::noOutputHandler();
  const auto si = information(q.world, q.clearance, true);
  auto problem = std::make_shared<ob::ProblemDefinition>(si);
  problem->setStartAndGoalStates(state(si, q.start), state(si, q.goal), q.goal_tolerance);
  auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(si);
  if (q.first_solution) objective->setCostThreshold(objective->infiniteCost());
  problem->setOptimizationObjective(objective);
  const ob::PlannerPtr planner = make(kind, si, q);
  planner->setProblemDefinition(problem);
  planner->setup();

  const auto began = std::chrono::steady_clock::now();
  const ob::PlannerStatus status =
      planner->solve(ob::timedPlannerTerminationCondition(q.max_seconds));
  OmplResult out;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  out.solved = status == ob::PlannerStatus::EXACT_SOLUTION;
  if (out.solved) out.length = problem->getSolutionPath()->length();
  ob::PlannerData data(si);
  planner->getPlannerData(data);
  out.vertices = data.numVertices();
  return out;
}

double ompl_motion_rate(const Snapshot& world, double clearance,
                        const std::vector<Segment>& edges) {
  const auto si = information(world, clearance, false);
  const auto from = state(si, {});
  const auto to = state(si, {});
  auto* a = from->as<ob::RealVectorStateSpace::StateType>();
  auto* b = to->as<ob::RealVectorStateSpace::StateType>();
  std::size_t free = 0;
  const auto began = std::chrono::steady_clock::now();
  for (const Segment& e : edges) {
    a->values[0] = e.a.x;
    a->values[1] = e.a.y;
    b->values[0] = e.b.x;
    b->values[1] = e.b.y;
    free += si->isValid(a) && si->checkMotion(a, b);
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return free > edges.size() ? 0 : static_cast<double>(edges.size()) / seconds;
}

}  // namespace microswarm::bench
