classdef Session < microswarm.internal.Handle
% microswarm.Session  An open experiment, which advances when it is stepped.
%
%   session = microswarm.Session('first_flight.yaml', 'seed', 3);
%   while true
%     frame = session.step();
%     if isempty(frame), break, end
%     plot(frame.x_um, frame.y_um, '.'); drawnow
%   end
%   result = session.result();
%
% A record (.h5) is played back. Lengths are in um, times in s, angles in rad; y points up.
%
% Methods: step, advance, set, status, metrics, obstacles, robots, path, frames, hash, result, save,
% close. A session that is cleared is closed.
% Errors: microswarm:bad_input for a file, key or value; microswarm:bad_call after close.

% SPDX-License-Identifier: Apache-2.0
  methods
    function self = Session(scenario, varargin)
    % Session(scenario, settings...)
    %
    % scenario   a file, or YAML text of several lines
    % settings   'KEY=VALUE', or 'KEY', value, with the keys of a scenario file
    %            and 'trial', k, which selects the random streams; default 0
      microswarm.internal.need(nargin, 1, 'a session needs a scenario');
      self.id = microswarm.internal.open_source('session', scenario, varargin);
    end

    function frame = step(self)
    % frame = session.step()   The next tick as a struct of all recorded quantities; [] when the run has ended.
    % What is not there is NaN.
      frame = microswarm_mex('session_step', self.id);
    end

    function ended = advance(self, ticks)
    % ended = session.advance(ticks)   Steps at most so many ticks; true if the run has ended.
      microswarm.internal.need(nargin, 2, 'advance needs the number of ticks');
      ended = microswarm_mex('session_advance', self.id, ticks);
    end

    function set(self, key, value)
    % session.set(key, value)   Sets a value from the next tick on: session.set('goal_um', [1500 300]).
      microswarm.internal.need(nargin, 3, 'set needs a key and a value');
      key = microswarm.internal.plain_text(key, 'the key');
      microswarm_mex('session_set', self.id, key, microswarm.internal.value_text(value, key));
    end

    function text = status(self)
    % text = session.status()   'running', or the final status: 'solved', 'collided', 'time_limit', ...
      text = microswarm_mex('session_status', self.id);
    end

    function values = metrics(self)
    % values = session.metrics()   Metrics so far as a struct, units in the names.
      values = microswarm.internal.with_infinity(jsondecode(microswarm_mex('session_metrics', self.id)));
    end

    function places = obstacles(self)
    % places = session.obstacles()   Rows x_um, y_um, radius_um of the current obstacles.
      places = microswarm_mex('session_obstacles', self.id);
    end

    function places = robots(self)
    % places = session.robots()   Current positions of individually tracked robots, n x 2 [um].
      places = microswarm_mex('session_robots', self.id);
    end

    function places = path(self)
    % places = session.path()   The followed path, n x 2 [um].
      places = microswarm_mex('session_path', self.id);
    end

    function columns = frames(self)
    % columns = session.frames()   All ticks so far: a struct of columns; after the end with one more row.
      columns = microswarm_mex('session_frames', self.id);
    end

    function text = hash(self)
    % text = session.hash()   Hash of the record so far: equal for equal runs.
      text = microswarm_mex('session_hash', self.id);
    end

    function made = result(self)
    % made = session.result()   Struct with status, metrics, frames and hash, so far.
      made = struct('status', self.status(), 'metrics', self.metrics(), 'frames', self.frames(), ...
                    'hash', self.hash());
    end

    function save(self, file)
    % session.save(file)   Writes the record (HDF5).
      microswarm.internal.need(nargin, 2, 'save needs a file');
      microswarm_mex('session_record', self.id, microswarm.internal.plain_text(file, 'the file'));
    end
  end
end
