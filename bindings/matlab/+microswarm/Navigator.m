classdef Navigator < microswarm.internal.Handle
% microswarm.Navigator  The navigator of a scenario in your own loop.
%
%   nav = microswarm.Navigator('chip.yaml');
%   nav = microswarm.Navigator('chip.yaml', 'goal_um', [1800 500], 'seed', 3);
%   command = nav.step(t, [x_um y_um heading_rad radius_um]);
%
% It maps the detections of your camera to the command for your coils. It uses map, swarm or robots,
% goal, navigator, tick and seed of the scenario, but not its obstacles.
%
% Lengths are in um, times in s, angles in rad, counter-clockwise from x; y points up.
%
% Methods: step, path, close. A navigator that is cleared is closed.
% Errors: microswarm:bad_input for a file, key or value; microswarm:bad_call after close.

% SPDX-License-Identifier: Apache-2.0
  methods
    function self = Navigator(scenario, varargin)
    % Navigator(scenario, settings...)
    %
    % scenario   a file, or YAML text of several lines
    % settings   'KEY=VALUE', or 'KEY', value, with the keys of a scenario file
    %            and 'trial', k, which selects the random streams; default 0
      microswarm.internal.need(nargin, 1, 'a navigator needs a scenario');
      self.id = microswarm.internal.open_source('navigator', scenario, varargin);
    end

    function command = step(self, t, swarm, obstacles, robots, varargin)
    % command = nav.step(t, swarm, obstacles, robots, 'seen', time, 'numbers', numbers, 'unseen', count)
    %
    % t           current time [s]; never before that of the previous step
    % swarm       [x_um y_um heading_rad radius_um]; [] if it was not detected, and for robots
    % obstacles   n x 3 with x_um, y_um, radius_um in each row, or a cell array of such rows and of
    %             outlines (n x 2); [] for none
    % robots      n x 2; row i is the same robot in every step
    % seen        time at which the picture was taken [s]; default t
    % numbers     one for each obstacle, constant over all steps, 0 or more; default: matched by distance
    % unseen      number of robots that were not detected, at expected positions; default 0
    %
    % command.heading_rad, command.speed_um_per_s   until the next step; speed 0 is a hold
    % command.state       'follow', 'hold', 'arrived', 'blind', ...
    % command.target_um   current local target; [] without one
    % command.planned     whether it called a planner
    %
    % A step that is refused (microswarm:bad_input) changes nothing.
      microswarm.internal.need(nargin, 2, 'step needs the time t');
      if nargin < 3, swarm = []; end
      if nargin < 4, obstacles = []; end
      if nargin < 5, robots = []; end
      seen = [];
      numbers = [];
      unseen = [];
      if nargin > 5, [seen, numbers, unseen] = options_of(varargin); end
      command = microswarm_mex('navigator_step', self.id, t, seen, swarm, obstacles, numbers, robots, unseen);
    end

    function places = path(self)
    % points = nav.path()   The path that it follows, n x 2 [um].
      places = microswarm_mex('navigator_path', self.id);
    end
  end
end

function [seen, numbers, unseen] = options_of(values)
  seen = [];
  numbers = [];
  unseen = [];
  for k = 1:2:numel(values)
    name = microswarm.internal.plain_text(values{k}, 'the name of an option');
    if k == numel(values), error('microswarm:bad_input', 'the option %s has no value', name); end
    switch name
      case 'seen', seen = values{k + 1};
      case 'numbers', numbers = values{k + 1};
      case 'unseen', unseen = values{k + 1};
      otherwise
        error('microswarm:bad_input', 'there is no option ''%s''; there are seen, numbers and unseen', name);
    end
  end
end
