// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/played_navigator.hpp"

namespace microswarm::experiment {

Command PlayedNavigator::step(const Observation& seen, const Stop&) {
  const std::vector<Frame>& frames = record_.frames;
  while (frame_ + 1 < frames.size() && frames[frame_].t < seen.now) ++frame_;
  if (frame_ >= frames.size()) return {};
  const Frame& frame = frames[frame_];
  while (path_ < record_.paths.size() && record_.paths[path_].t <= frame.t) ++path_;
  while (plan_ < record_.plans.size() && record_.plans[plan_].t <= frame.t) ++plan_;
  const std::vector<PhasedGoal>& goals = record_.phased_goals;
  while (goal_ < goals.size() && goals[goal_].t <= frame.t) ++goal_;
  view_ = {
      .planned = frame.planned, .state = frame.state, .local_target = frame.target, .path = {}};
  if (goal_ > 0) view_.phased_goal = goals[goal_ - 1].point;
  if (path_ > 0) view_.path = record_.paths[path_ - 1].path;
  if (plan_ > 0) view_.plan = &record_.plans[plan_ - 1].plan;
  return frame.command;
}

Diagnostics PlayedNavigator::diagnostics() const {
  if (frame_ >= record_.frames.size()) return {};
  return record_.diagnostics.at(record_.frames[frame_].t);
}

}  // namespace microswarm::experiment
