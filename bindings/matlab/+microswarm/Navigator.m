classdef Navigator < microswarm.internal.Handle
% microswarm.Navigator  The navigator of a scenario in a loop of your own.
%
%   nav = microswarm.Navigator('chip.yaml');
%   nav = microswarm.Navigator('chip.yaml', 'goal_um', [1800 500], 'seed', 3);
%   command = nav.step(t, [x_um y_um heading_rad radius_um]);
%
% In goes what your camera sees, out comes the command for your coils. Of the scenario it uses map,
% swarm or robots, goal, navigator, tick and seed; the scenario's obstacles are not used.
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
    %            and 'trial', k, which selects the random streams; 0 without
      microswarm.internal.need(nargin, 1, 'a navigator needs a scenario');
      self.id = microswarm.internal.open_source('navigator', scenario, varargin);
    end

    function command = step(self, t, swarm, obstacles, robots, varargin)
    % command = nav.step(t, swarm, obstacles, robots, 'seen', time, 'numbers', numbers, 'unseen', count)
    %
    % t           the present [s]; never before that of the step before
    % swarm       [x_um y_um heading_rad radius_um]; [] if it was not found, and for robots
    % obstacles   n x 3 with x_um, y_um, radius_um in each row, or a cell array of such rows and of
    %             outlines (n x 2); [] for none
    % robots      n x 2; robot i is the same in every step
    % seen        when the picture was taken [s]; t without
    % numbers     one for each obstacle, the same in every step, 0 or more; without, they are matched by distance
    % unseen      how many of the robots were not seen and are where they are expected; 0 without
    %
    % command.heading_rad, command.speed_um_per_s   to drive until the next step; speed 0 is hold
    % command.state       'follow', 'hold', 'arrived', 'blind', ...
    % command.target_um   what it heads for now; [] without
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
    % places = nav.path()   The path that it follows, n x 2 [um].
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
