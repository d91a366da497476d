% SPDX-License-Identifier: Apache-2.0
function tests = test_gateway()
% test_gateway  What the MEX file itself refuses, and its end.
  tests = {@bad_calls, @classes_that_fit_nowhere, @help_is_there, @all_is_closed_with_the_file};
end

function bad_calls(world)
  refuses(@() microswarm_mex(), 'bad_call', 'needs a command');
  refuses(@() microswarm_mex(3), 'bad_input', 'the command must be a text');
  refuses(@() microswarm_mex(''), 'bad_call', 'no command');
  refuses(@() microswarm_mex('fly'), 'bad_call', 'no command ''fly''');
  refuses(@() microswarm_mex('plan', 1), 'bad_call', 'takes 5 arguments, not 1');
  for bad = {1, [], uint64([]), uint64([1 2]), 'a', {uint64(1)}}
    refuses(@() microswarm_mex('session_step', bad{1}), 'bad_call', 'handle');
  end
  refuses(@() microswarm_mex('session_step', uint64(123456)), 'bad_call', 'never');
  map = microswarm.Map(true(9, 9), 10);
  refuses(@() microswarm_mex('session_step', map.id), 'bad_call', 'not that of a session');
  refuses(@() microswarm_mex('session_open', world.flight, 'seed=1', 0), 'bad_input', 'cell array');
  refuses(@() microswarm_mex('session_open', world.flight, {1}, 0), 'bad_input', 'setting');
  refuses(@() microswarm_mex('session_open', world.flight, cell(1, 2), 0), 'bad_input', 'setting');
  refuses(@() microswarm_mex('session_open', ['a' char(0) 'b'], {}, 0), 'bad_input', 'zero character');
  refuses(@() microswarm_mex('session_open', ['ab'; 'cd'], {}, 0), 'bad_input', 'one row');
  session = microswarm.Session(world.flight);
  for bad = {-1, 0.5, NaN, Inf, [], 'a'}
    refuses(@() session.advance(bad{1}), 'bad_input', 'ticks');
  end
  refuses(@() session.advance(), 'bad_call', 'advance needs');
  refuses(@() session.set(), 'bad_call', 'set needs');
  refuses(@() session.set('goal_um'), 'bad_call', 'set needs a key and a value');
  refuses(@() session.save(), 'bad_call', 'save needs');
  refuses(@() session.save('no/such/folder/run.h5'), 'bad_input', 'no/such/folder');
  refuses(@() session.save(3), 'bad_input', 'the file');
  assert(~isempty(regexp(microswarm.version(), '^\d+\.\d+\.\d+$', 'once')));
end

function classes_that_fit_nowhere(world)
  nav = microswarm.Navigator(world.flight);
  map = microswarm.Map(true(9, 9), 10);
  session = microswarm.Session(world.flight);
  good = [200 500 0 40];
  for bad = {@sin, struct('a', 1), containers.Map(), nav, 1i, {@sin}, 'x', true}
    bad = bad{1};
    refuses(@() microswarm.Map(bad, bad), 'bad_input', '');
    refuses(@() microswarm.Navigator(bad), 'bad_input', '');
    refuses(@() microswarm.run(world.flight, bad, 3), 'bad_input', '');
    refuses(@() microswarm.run(world.flight, 'seed', bad), 'bad_input', '');
    refuses(@() microswarm.plan(map, bad, [50 50]), 'bad_input', '');
    refuses(@() microswarm.plan(map, [50 50], bad), 'bad_input', '');
    refuses(@() microswarm.plan(bad, [50 50], [60 50], 'um_per_px', 'x'), 'bad_input', '');
    refuses(@() microswarm.read_record(bad), 'bad_input', '');
    refuses(@() map.clearance(bad), 'bad_input', '');
    refuses(@() session.advance(bad), 'bad_input', '');
    refuses(@() session.set(bad, 1), 'bad_input', '');
    refuses(@() session.save({bad}), 'bad_input', '');
    refuses(@() nav.step(bad, good), 'bad_input', '');
    refuses(@() nav.step(0, bad), 'bad_input', '');
    refuses(@() nav.step(0, good, bad), 'bad_input', '');
    refuses(@() nav.step(0, good, {bad}), 'bad_input', '');
    refuses(@() nav.step(0, good, [], bad), 'bad_input', '');
    refuses(@() nav.step(0, good, [], [], 'numbers', bad), 'bad_input', '');
    refuses(@() nav.step(0, good, [], [], 'seen', bad), 'bad_input', '');
    refuses(@() nav.step(0, good, [], [], bad, 0), 'bad_input', '');
  end
end

function help_is_there(world)
  for name = {'run', 'plan', 'read_record', 'version', 'Navigator', 'Session', 'Map'}
    text = evalc(['help microswarm.' name{1}]);
    assert(~isempty(strfind(text, ['microswarm.' name{1} '  '])), name{1});
  end
end

function all_is_closed_with_the_file(world)
  session = microswarm.Session(world.flight);
  session.step();
  clear('microswarm_mex');
  refuses(@() session.step(), 'bad_call', 'closed');
  other = microswarm.Session(world.flight);
  assert(other.id ~= session.id);
  session.delete();
  assert(strcmp(other.status(), 'running'));
end
