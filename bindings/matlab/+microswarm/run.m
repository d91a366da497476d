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
% result.metrics   struct, units in the names; Inf for a distance that never came about
% result.frames    struct of columns with a row for each tick and one for the end, all that a record has:
%                  t_s, x_um, goal_distance_um, ..., state (cell array of texts), planned (logical)
% result.hash      fingerprint of the record, that of `microswarm run`: equal for equal runs
%
% Ctrl-C ends it between ticks. Errors: microswarm:bad_input for a file, key or value.

  % SPDX-License-Identifier: Apache-2.0
  microswarm.internal.need(nargin, 1, 'run needs a scenario');
  session = microswarm.Session(scenario, varargin{:});
  while ~session.advance(20), end
  result = session.result();
  session.close();
end
