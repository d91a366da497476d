function result = run(scenario, varargin)
% microswarm.run  Runs a scenario to its end.
%
%   result = microswarm.run('first_flight.yaml')
%   result = microswarm.run('first_flight.yaml', 'seed', 3, 'navigator.speed_um_per_s', 60)
%
% scenario   a file, or YAML text of several lines
% settings   'KEY=VALUE', or 'KEY', value, with the keys of a scenario file
%            and 'trial', k, which selects the random streams; default 0
%
% result.status    'solved', 'collided', 'time_limit', ...
% result.metrics   struct, units in the names; Inf for a distance that was never measured
% result.frames    struct of columns with a row for each tick and one for the end: t_s, x_um, y_um,
%                  heading_rad, command_speed_um_per_s, ..., state (cell array), planned (logical)
% result.hash      hash of the record, as by `microswarm run`: equal for equal runs
%
% Ctrl-C ends it between ticks. Errors: microswarm:bad_input for a file, key or value.

  % SPDX-License-Identifier: Apache-2.0
  microswarm.internal.need(nargin, 1, 'run needs a scenario');
  session = microswarm.Session(scenario, varargin{:});
  while ~session.advance(20), end
  result = session.result();
  session.close();
end
