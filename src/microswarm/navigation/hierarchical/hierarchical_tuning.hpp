// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/prediction/obstacle_predictor_tuning.hpp"

namespace microswarm::navigation {

/// Constants of HierarchicalNavigator that rarely need a change.
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
  double patience = 15;
  ObstaclePredictorTuning prediction{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed_shares,
          plain("speed_shares", 1e-3, 1, "Shares of the speed tried along the path."));
    visit(self.check_step, s("check_step", 1e-3, 10, "Time step of the check of a command."));
    visit(self.max_sweep,
          s("max_sweep", 0, 60, "Time for which obstacles are swept while planning."));
    visit(self.first_leg, s("first_leg", 0, 60, "Duration of the first leg of an escape."));
    visit(self.final_weight,
          plain("final_weight", 0, 100, "Weight of the clearance at the end of an escape."));
    visit(self.detour, um("detour", 0, 1e8, "Extra distance where no route is known."));
    visit(self.wait_times,
          s("wait_times", 0, 1e3, "Waits for an obstacle to pass, ascending from 0."));
    visit(self.wait_weight,
          plain("wait_weight", 0, 1e3, "Cost of a wait, per distance not driven."));
    visit(self.contact_weight,
          plain("contact_weight", 0, 1e3, "Cost of a contact, per distance left in the horizon."));
    visit(self.patience,
          s("patience", 0.5, 1e9, "Time without progress after which a safe interval leads."));
    visit(self.prediction, plain("prediction", "Prediction of obstacles."));
  }
};

}  // namespace microswarm::navigation
