% SPDX-License-Identifier: Apache-2.0
function command = camera_loop(scenario, picture, now, coils, um_per_px)
% camera_loop  Camera to coil currents, with a navigator of microswarm between them.
%
% picture   function that gives a grey picture; now: that gives its time [s]
% coils     function that takes the currents [A] of the coils x and y
  nav = microswarm.Navigator(scenario);
  off = onCleanup(@() coils([0 0]));          % also after an error or Ctrl-C
  heading_rad = 0;
  while true
    t = now();
    swarm = find_swarm(picture(), heading_rad, um_per_px);
    command = nav.step(t, swarm);             % obstacles: a third argument, rows x, y, radius
    if strcmp(command.state, 'arrived'), break, end
    heading_rad = command.heading_rad;
    amplitude_a = command.speed_um_per_s / 80;  % your swarm: 1 A drives it at 80 um/s
    coils(amplitude_a * [cos(heading_rad) sin(heading_rad)]);
  end
end

function swarm = find_swarm(picture, heading_rad, um_per_px)
  [row, column] = find(picture < 128);        % dark on a bright ground
  swarm = [];                                 % not found: the navigator holds
  if numel(row) < 5, return, end
  x_um = (mean(column) - 0.5) * um_per_px;
  y_um = (size(picture, 1) - mean(row) + 0.5) * um_per_px;  % y points up
  swarm = [x_um, y_um, heading_rad, um_per_px * sqrt(numel(row) / pi)];
end
