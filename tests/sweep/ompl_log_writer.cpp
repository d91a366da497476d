// SPDX-License-Identifier: Apache-2.0
// Writes a benchmark log with OMPL's own class: ompl_log_writer FILE. Two planners, one of them
// with progress properties, in an empty square.
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/tools/benchmark/Benchmark.h>
#include <ompl/util/Console.h>

#include <memory>

int main(int count, char** arguments) {
  if (count != 2) return 2;
  ompl::msg::noOutputHandler();
  const auto square = std::make_shared<ompl::base::RealVectorStateSpace>(2);
  square->setBounds(0, 1);
  ompl::geometric::SimpleSetup setup(square);
  setup.setStateValidityChecker([](const ompl::base::State*) { return true; });
  ompl::base::ScopedState<> start(square), goal(square);
  start[0] = start[1] = 0.1;
  goal[0] = goal[1] = 0.9;
  setup.setStartAndGoalStates(start, goal);
  ompl::tools::Benchmark benchmark(setup, "square");
  benchmark.addExperimentParameter("width", "REAL", "0.5");
  const auto& space = setup.getSpaceInformation();
  benchmark.addPlanner(std::make_shared<ompl::geometric::RRTConnect>(space));
  benchmark.addPlanner(std::make_shared<ompl::geometric::RRTstar>(space));
  constexpr double seconds = 0.1, megabytes = 1000, period = 0.02;
  benchmark.benchmark({seconds, megabytes, 3, period, false, true, false});
  return benchmark.saveResultsToFile(arguments[1]) ? 0 : 1;
}
