% SPDX-License-Identifier: Apache-2.0
function rig = simulated_rig(place_um, um_per_px)
% simulated_rig  A camera and coils for camera_loop: a dark disc of 40 um that goes where the field points.
%
% rig.picture()   uint8, 2000 um x 1000 um, the upper row first
% rig.time()      0.1 s more at each call
% rig.coils(a)    currents of the coils x and y; 1 A is 80 um/s
% rig.place()     where the swarm is [um]
  state = containers.Map({'place', 'time'}, {place_um, 0});
  rig.picture = @() picture_of(state('place'), um_per_px);
  rig.time = @() tick(state);
  rig.coils = @(currents_a) move(state, currents_a);
  rig.place = @() state('place');
end

function picture = picture_of(place, um_per_px)
  rows = round(1000 / um_per_px);
  columns = round(2000 / um_per_px);
  [x, y] = meshgrid(((1:columns) - 0.5) * um_per_px, (rows - (1:rows) + 0.5) * um_per_px);
  picture = uint8(230 - 190 * ((x - place(1)) .^ 2 + (y - place(2)) .^ 2 < 40 ^ 2));
end

function now = tick(state)
  now = state('time');
  state('time') = now + 0.1;
end

function move(state, currents_a)
  state('place') = state('place') + 0.1 * 80 * currents_a;
end
