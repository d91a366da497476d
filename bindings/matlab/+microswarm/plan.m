function path = plan(map, start, goal, varargin)
% microswarm.plan  Plans a path in a map.
%
%   path = microswarm.plan('room.png', [50 50], [350 50], 'um_per_px', 10)
%   path = microswarm.plan(free, [50 50], [350 50], 'um_per_px', 10, ...
%                          'planner', 'drrt_star', 'clearance_um', 40, 'max_nodes', 5000)
%
% map        a file, a matrix of class logical or uint8, the upper row first (free where it is true; a grey
%            picture of uint8 where it is at least 128), or a microswarm.Map, which is faster for many paths
% start      [x_um y_um] or [x_um y_um heading_rad]
% goal       [x_um y_um]
%
% um_per_px  side of a pixel or cell [um], where the map does not tell it
% threshold, free, um_per_unit   and others as 'map.KEY': values of the map, as of microswarm.Map
% planner    'exact', the shortest path, which is the default, or another: one that is not known
%            is an error that lists them
% seed       a whole number; 1 without
% others     values of the planner, units in the names: 'clearance_um', 'step_um', ...; what is not
%            given follows from the map
%
% path.solved        false: the points are the beginning of a path
% path.points_um     n x 2
% path.length_um, path.turning_rad   of true arcs
% path.time_s        computing time of the planner
% path.why_none      why there is no path; '' with one
%
% Errors: microswarm:bad_input for a file, matrix, position or value.

  % SPDX-License-Identifier: Apache-2.0
  microswarm.internal.need(nargin, 3, 'plan needs a map, a start and a goal');
  um_per_px = 0;
  map_values = {};
  seed = 1;
  settings = {'planner.type=exact'};
  for k = 1:2:numel(varargin)
    name = microswarm.internal.plain_text(varargin{k}, 'the name of a value');
    if k == numel(varargin), error('microswarm:bad_input', 'the value of %s is missing', name); end
    value = varargin{k + 1};
    if strncmp(name, 'map.', 4)
      map_values(end + 1:end + 2) = {name(5:end), value};
      continue;
    end
    switch name
      case 'um_per_px', um_per_px = value;
      case {'threshold', 'free', 'um_per_unit'}, map_values(end + 1:end + 2) = {name, value};
      case 'seed', seed = value;
      case 'planner', settings{1} = ['planner.type=' microswarm.internal.plain_text(value, 'planner')];
      otherwise, settings(end + 1) = microswarm.internal.settings_of({name, value}, 'planner.');  %#ok<AGROW>
    end
  end
  if ~isa(map, 'microswarm.Map')
    map = microswarm.Map(map, um_per_px, map_values{:});
  elseif ~isempty(map_values) || ~isequal(um_per_px, 0)
    error('microswarm:bad_input', 'um_per_px, threshold and others are values of a map, and this one is open');
  end
  path = microswarm_mex('plan', map.id, start, goal, seed, settings);
end
