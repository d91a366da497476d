// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/obstacle_predictor_tuning.hpp"

namespace microswarm {

/// Constants of HierarchicalNavigator that seldom need a change.
struct HierarchicalTuning {
  std::vector<double> speed_shares{1, 0.5, 0.25};
  double check_step = 0.1;
  double max_sweep = 1.5;
  double first_leg = 1;
  double final_weight = 0.1;
  double detour = 1e4;
  std::vector<double> wait_times{0, 1, 2, 4, 8};
  double wait_weight = 2;
  double contact_weight = 3;
  ObstaclePredictorTuning prediction;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed_shares,
          {"speed_shares", Unit::none, {1e-3, 1}, "Shares of the speed tried along the path."});
    visit(self.check_step,
          {"check_step", Unit::s, {1e-3, 10}, "Time step of the check of a command."});
    visit(self.max_sweep,
          {"max_sweep", Unit::s, {0, 60}, "Time for which obstacles are swept while planning."});
    visit(self.first_leg,
          {"first_leg", Unit::s, {0, 60}, "Duration of the first leg of an escape."});
    visit(
        self.final_weight,
        {"final_weight", Unit::none, {0, 100}, "Weight of the clearance at the end of an escape."});
    visit(self.detour, {"detour", Unit::um, {0, 1e8}, "Extra distance where no route is known."});
    visit(self.wait_times,
          {"wait_times", Unit::s, {0, 1e3}, "Waits for an obstacle to pass, ascending from 0."});
    visit(self.wait_weight,
          {"wait_weight", Unit::none, {0, 1e3}, "Cost of a wait, per distance not driven."});
    visit(self.contact_weight, {"contact_weight",
                                Unit::none,
                                {0, 1e3},
                                "Cost of a contact, per distance left in the horizon."});
    visit(self.prediction, {"prediction", Unit::none, {}, "Prediction of obstacles."});
  }
};

}  // namespace microswarm
