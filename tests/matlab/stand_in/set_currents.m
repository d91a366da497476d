% SPDX-License-Identifier: Apache-2.0
function set_currents(currents_a)
% set_currents  The coils of the simulated rig.
  global simulated
  simulated.coils(currents_a);
end
